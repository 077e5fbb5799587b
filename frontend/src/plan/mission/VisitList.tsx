import { ActionIcon, SegmentedControl } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";

import type { Mission, RowExit, RowVisit, SiteMap } from "../../api/types";
import { rowWords } from "../../ui/words";
import { NumberField } from "../farm/NumberField";
import css from "../plan.module.css";
import { EXITS } from "./exits";
import { changeVisit, removeVisit } from "./missionEdits";

const SIDES = [
  { value: "start", label: "From its start" },
  { value: "end", label: "From its end" },
];

export function VisitList({ site, mission, onEdit }: { site: SiteMap; mission: Mission; onEdit: (mission: Mission) => void }) {
  const names = new Map(site.rows.map(({ id, name }) => [id, name]));
  return (
    <div className={css.stack}>
      {mission.visits.map((visit, index) => (
        <Visit
          key={`${index}:${visit.row_id}`}
          visit={visit}
          name={rowWords(visit.row_id, names)}
          onChange={(change) => onEdit(changeVisit(mission, index, change))}
          onRemove={() => onEdit(removeVisit(mission, index))}
        />
      ))}
      <p className={css.quiet}>Press another row on the map to add it.</p>
    </div>
  );
}

interface VisitProps {
  visit: RowVisit;
  name: string;
  onChange: (change: Partial<RowVisit>) => void;
  onRemove: () => void;
}

function Visit({ visit, name, onChange, onRemove }: VisitProps) {
  return (
    <div className={css.visit}>
      <div className={css.header}>
        <b className={css.grow}>{name}</b>
        <ActionIcon onClick={onRemove} aria-label={`Take ${name} out`}>
          <IconTrash size={20} />
        </ActionIcon>
      </div>
      <SegmentedControl fullWidth value={visit.from_start ? "start" : "end"} onChange={(side) => onChange({ from_start: side === "start" })} data={SIDES} />
      <SegmentedControl fullWidth value={visit.exit} onChange={(exit) => onChange({ exit: exit as RowExit })} data={EXITS} aria-label="At the far end" />
      <NumberField steps label="Speed in the row" unit="m/s" min={0.1} max={2} step={0.1} value={visit.speed} onChange={(speed) => onChange({ speed })} />
    </div>
  );
}
