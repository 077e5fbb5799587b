import { TextInput } from "@mantine/core";
import { useEffect, useRef, useState } from "react";

import type { RowProposal, SiteDocument, SiteMap } from "../../api/types";
import { type ItemRef, WAREHOUSE, sameItem } from "../../map/siteFeatures";
import { distance, length } from "../../geo/measure";
import { Card } from "../../ui/Card";
import { metres } from "../../ui/format";
import { PhotoButton } from "../imports/ImportButtons";
import css from "../plan.module.css";
import { MapRowsButton } from "../proposal/MapRowsButton";
import { ProposalCard } from "../proposal/ProposalCard";
import type { SiteEditing } from "../useSiteEditor";
import { ItemPanel } from "./ItemPanel";
import { nextStep } from "./nextStep";

interface Props {
  document: SiteDocument;
  editing: SiteEditing;
  /** Found in a 3D map, and not accepted yet. */
  found: RowProposal | null;
  selected: ItemRef | null;
  onSelect: (ref: ItemRef | null) => void;
}

export function FarmPanel({ document, editing, found, selected, onSelect }: Props) {
  const { site, commit } = editing;
  const step = nextStep(site);
  const top = useRef<HTMLDivElement>(null);
  const [picked, setPicked] = useState<ItemRef | null>(null);
  const pick = (ref: ItemRef) => {
    onSelect(ref);
    setPicked({ ...ref });
  };
  // What is picked far down in the list shows its numbers at the top.
  useEffect(() => {
    if (picked) top.current?.scrollIntoView({ block: "start" });
  }, [picked]);
  return (
    <div className={css.stack} ref={top}>
      {found && <ProposalCard siteId={document.id} found={found} editing={editing} />}
      {selected && <ItemPanel site={site} selected={selected} onCommit={commit} onSelect={onSelect} />}
      {step && <Card title="Next step">{step}</Card>}
      <Card title="This farm">
        <div className={css.stack}>
          <TextInput label="Name" value={site.name} maxLength={100} onChange={(event) => commit({ ...site, name: event.currentTarget.value })} />
          {document.orthophoto ? (
            <p className={css.quiet}>
              Picture: {document.orthophoto.file_name}, {document.orthophoto.crs}, {Math.round(document.orthophoto.resolution * 100)} cm per pixel
            </p>
          ) : (
            <PhotoButton path={`/api/sites/${document.id}/orthophoto`} word="Add an orthophoto" />
          )}
          <MapRowsButton siteId={document.id} />
        </div>
      </Card>
      <Card title="Drawn">
        <Items site={site} selected={selected} onSelect={pick} />
      </Card>
    </div>
  );
}

function Items({ site, selected, onSelect }: { site: SiteMap; selected: ItemRef | null; onSelect: (ref: ItemRef) => void }) {
  const items = listed(site);
  if (items.length === 0) return <p className={css.quiet}>Nothing yet.</p>;
  return (
    <ul className={css.list}>
      {items.map(({ ref, name, note }) => (
        <li key={`${ref.kind}:${ref.id}`}>
          <button type="button" className={css.item} aria-pressed={sameItem(ref, selected)} onClick={() => onSelect(ref)}>
            {name}
            <small>{note}</small>
          </button>
        </li>
      ))}
    </ul>
  );
}

function listed(site: SiteMap): { ref: ItemRef; name: string; note: string }[] {
  return [
    ...(site.warehouse ? [{ ref: WAREHOUSE, name: site.warehouse.name, note: "warehouse" }] : []),
    ...site.lanes.map((lane) => ({ ref: { kind: "lane" as const, id: lane.id }, name: lane.name || lane.id, note: `lane, ${metres(length(lane.points))}` })),
    ...site.rows.map((row) => ({ ref: { kind: "row" as const, id: row.id }, name: row.name || row.id, note: `row, ${metres(distance(row.start, row.end))}` })),
    ...site.zones.map((zone) => ({ ref: { kind: "zone" as const, id: zone.id }, name: zone.name || zone.id, note: zone.kind.replace("_", "-") })),
  ];
}
