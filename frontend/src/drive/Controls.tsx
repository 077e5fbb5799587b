import { Button, Select } from "@mantine/core";
import { IconCheck, IconPlayerPause, IconPlayerPlay, IconPlayerTrackNext } from "@tabler/icons-react";
import { useMutation } from "@tanstack/react-query";
import { useEffect, useState } from "react";
import { Link } from "wouter";

import { post } from "../api/client";
import type { MissionDocument, Preview, RunState, SiteDocument } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { HoldButton } from "../ui/HoldButton";
import { isUnderWay } from "../ui/words";
import { BackToWarehouse } from "./BackToWarehouse";
import { StartSheet } from "./StartSheet";
import css from "./drive.module.css";

type Action = "pause" | "resume" | "acknowledge";

const ACTIONS: Record<Action, { word: string; icon: typeof IconCheck; when: (state: RunState, guard: string) => boolean }> = {
  pause: { word: "Pause", icon: IconPlayerPause, when: (state) => state === "driving" || state === "holding" || state === "starting" },
  resume: { word: "Resume", icon: IconPlayerTrackNext, when: (state) => state === "paused" },
  acknowledge: { word: "Acknowledge", icon: IconCheck, when: (state, guard) => state === "stopped" || guard === "latched" },
};

interface Props {
  document: SiteDocument;
  missions: MissionDocument[];
  mission: MissionDocument | null;
  preview: Preview | undefined;
  onMission: (id: string) => void;
}

/** Only what makes sense now; off while the data are old. What leads from a stop to moving must be held. */
export function Controls({ document, missions, mission, preview, onMission }: Props) {
  const status = useTopic("nav/status");
  const fresh = useFresh("nav/status");
  const state = status?.state;
  const [sheet, setSheet] = useState(false);
  const act = useMutation({ mutationFn: (action: Action) => post(`/api/runs/current/${action}`) });
  const idle = !isUnderWay(state);
  // A sheet left open must not come back by itself when the mission has ended.
  useEffect(() => {
    if (!idle) setSheet(false);
  }, [idle]);
  const ready = state === "idle" || state === "finished" || state === undefined;
  const shown = (Object.keys(ACTIONS) as Action[]).filter((a) => state && ACTIONS[a].when(state, status?.guard ?? ""));
  return (
    <div className={css.controls}>
      {ready && <BackToWarehouse document={document} />}
      {ready && <MissionChoice missions={missions} mission={mission} onMission={onMission} siteId={document.id} />}
      {ready && mission && (
        <Button size="lg" leftSection={<IconPlayerPlay size={24} />} disabled={!fresh} onClick={() => setSheet(true)}>
          Start …
        </Button>
      )}
      {shown.map((action) => {
        const { word, icon: Glyph } = ACTIONS[action];
        return (
          <Button key={action} size="lg" variant={action === "pause" ? "default" : "filled"} leftSection={<Glyph size={24} />} loading={act.isPending} disabled={!fresh} onClick={() => act.mutate(action)}>
            {word}
          </Button>
        );
      })}
      {state === "stopped" && (
        <div className={css.resume}>
          <HoldButton disabled={!fresh || act.isPending} onHeld={() => act.mutate("resume")}>
            Hold to resume
          </HoldButton>
        </div>
      )}
      {mission && <StartSheet opened={sheet} onClose={() => setSheet(false)} document={document} mission={mission} preview={preview} />}
    </div>
  );
}

function MissionChoice({ missions, mission, onMission, siteId }: Pick<Props, "missions" | "mission" | "onMission"> & { siteId: string }) {
  if (missions.length === 0) {
    return (
      <Button component={Link} href={`/plan/${siteId}`} size="lg" variant="light">
        Make a mission first
      </Button>
    );
  }
  const data = missions.map(({ id, name }) => ({ value: id, label: name }));
  return <Select aria-label="Mission" size="lg" className={css.mission} data={data} value={mission?.id ?? null} onChange={(id) => id && onMission(id)} />;
}
