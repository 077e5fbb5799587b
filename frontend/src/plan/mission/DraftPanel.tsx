import { Button, TextInput } from "@mantine/core";
import { IconArrowLeft, IconDeviceFloppy } from "@tabler/icons-react";

import type { SiteMap } from "../../api/types";
import { Card } from "../../ui/Card";
import css from "../plan.module.css";
import { PreviewCard } from "./PreviewCard";
import { VisitList } from "./VisitList";
import { WaypointList } from "./WaypointList";
import type { MissionDraft } from "./useMissionDraft";

/** The mission being made, in the order in which it is driven. */
export function DraftPanel({ site, draft }: { site: SiteMap; draft: MissionDraft }) {
  const { mission } = draft.draft!;
  const leave = () => {
    if (!draft.unsaved || window.confirm("Leave this mission without saving it?")) draft.close();
  };
  return (
    <div className={css.stack}>
      <PreviewCard site={site} draft={draft} mission={mission} />
      <TextInput label="Name" value={mission.name} maxLength={100} onChange={(event) => draft.edit({ ...mission, name: event.currentTarget.value })} />
      <Card title="Rows, in this order">
        <VisitList site={site} mission={mission} onEdit={draft.edit} />
      </Card>
      <Card title="Way there">
        <WaypointList mission={mission} leg="outbound" first={1} onEdit={draft.edit} />
      </Card>
      <Card title="Way back">
        <WaypointList mission={mission} leg="inbound" first={mission.outbound.length + 1} onEdit={draft.edit} />
      </Card>
      <div className={css.bar}>
        <Button variant="default" size="lg" leftSection={<IconArrowLeft size={22} />} onClick={leave}>
          Missions
        </Button>
        <Button size="lg" leftSection={<IconDeviceFloppy size={22} />} disabled={!draft.unsaved} loading={draft.save.isPending} onClick={() => draft.save.mutate(draft.draft!)}>
          {draft.unsaved ? "Save" : "Saved"}
        </Button>
      </div>
    </div>
  );
}
