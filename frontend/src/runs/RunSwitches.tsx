import { SegmentedControl } from "@mantine/core";
import { useMemo, useState } from "react";

import type { RunDetail, RunTrack } from "../api/types";
import { SwitchList } from "../plots/SwitchList";
import { switchTimes } from "../plots/switchTimes";
import { Card } from "../ui/Card";
import { clock } from "../ui/format";
import css from "./runs.module.css";

/** Switches and events; a press goes to the moment. */
export function RunSwitches({ run, track, onPick }: { run: RunDetail; track: RunTrack; onPick: (t: number) => void }) {
  const [tab, setTab] = useState("switches");
  const times = useMemo(() => switchTimes(track), [track]);
  const tabs = [
    { value: "switches", label: `Switches (${track.switches.length})` },
    { value: "events", label: `Events (${run.events.length})` },
  ];
  return (
    <Card>
      <SegmentedControl fullWidth mb="sm" value={tab} onChange={setTab} data={tabs} />
      {tab === "switches" ? (
        <SwitchList switches={track.switches} timeOf={(item) => times.get(item)} onPick={onPick} />
      ) : (
        <ul className={css.events}>
          {run.events.map((event) => (
            <li key={`${event.t_s}:${event.text}`}>
              <button type="button" onClick={() => onPick(event.t_s)}>
                <b>{clock(event.t_s)}</b> {event.text}
              </button>
            </li>
          ))}
        </ul>
      )}
    </Card>
  );
}
