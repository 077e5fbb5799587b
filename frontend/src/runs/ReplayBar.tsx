import { ActionIcon, SegmentedControl, Slider } from "@mantine/core";
import { IconPlayerPauseFilled, IconPlayerPlayFilled } from "@tabler/icons-react";

import type { RunTrack } from "../api/types";
import { centimetres, clock, speed } from "../ui/format";
import { MODE_COLORS, MODE_WORDS } from "../ui/words";
import css from "./runs.module.css";
import type { Playback } from "./usePlayback";

const SPEEDS = [1, 4, 16].map((value) => ({ value: String(value), label: `${value}×` }));

/** Play, pause, and where in the run we are. */
export function ReplayBar({ playback, track, index, end }: { playback: Playback; track: RunTrack; index: number; end: number }) {
  const mode = track.mode[index]!;
  return (
    <div className={css.bar}>
      <ActionIcon size={52} variant="filled" onClick={playback.toggle} aria-label={playback.playing ? "Pause the replay" : "Play the replay"}>
        {playback.playing ? <IconPlayerPauseFilled /> : <IconPlayerPlayFilled />}
      </ActionIcon>
      <div className={css.slide}>
        <Slider size="xl" min={0} max={end} step={0.1} value={playback.t} onChange={playback.seek} label={clock} thumbLabel="Time in the run" />
        <div className={css.now}>
          <b>
            {clock(playback.t)} of {clock(end)}
          </b>
          <span style={{ "--mode": MODE_COLORS[mode] } as React.CSSProperties}>{MODE_WORDS[mode]}</span>
          <span>{speed(track.v[index])}</span>
          <span>{centimetres(track.lateral_error[index])} off the line</span>
        </div>
      </div>
      <SegmentedControl value={String(playback.speed)} onChange={(value) => playback.setSpeed(Number(value))} data={SPEEDS} aria-label="Speed of the replay" />
    </div>
  );
}
