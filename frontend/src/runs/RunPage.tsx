import { Button, Loader } from "@mantine/core";
import { IconRoute } from "@tabler/icons-react";
import { useQuery } from "@tanstack/react-query";
import { useMemo } from "react";
import { Link } from "wouter";

import { sentences } from "../api/client";
import { robotQuery, runQuery, siteQuery, trackQuery } from "../api/queries";
import type { RunDetail, RunTrack } from "../api/types";
import { indexAt } from "../plots/bands";
import { EmptyState } from "../ui/EmptyState";
import { Reasons } from "../ui/Reasons";
import { ReplayBar } from "./ReplayBar";
import { ReplayCamera } from "./ReplayCamera";
import { ReplayMap } from "./ReplayMap";
import { RunHeader } from "./RunHeader";
import { RunPlots } from "./RunPlots";
import { RunSwitches } from "./RunSwitches";
import css from "./runs.module.css";
import { usePlayback } from "./usePlayback";

/** One run, to be looked at again. */
export function RunPage({ runId }: { runId: string }) {
  const run = useQuery(runQuery(runId));
  const track = useQuery({ ...trackQuery(runId, run.data?.ended ?? null), enabled: Boolean(run.data?.ended) });
  const error = run.error ?? track.error;
  if (!run.data) return error ? <Reasons reasons={sentences(error)} /> : <Loader m="xl" />;
  return (
    <div className={css.detail}>
      <RunHeader run={run.data} />
      {run.data.ended === null ? <StillGoing /> : track.data && track.data.t_s.length > 0 ? <Replay run={run.data} track={track.data} /> : <NoTrack error={track.error} loading={track.isPending} />}
    </div>
  );
}

function StillGoing() {
  const toDrive = (
    <Button component={Link} href="/drive" size="lg">
      Watch it on Drive
    </Button>
  );
  return (
    <div className={css.whole}>
      <EmptyState icon={IconRoute} title="The robot is still on its way" action={toDrive}>
        The run can be replayed here as soon as it has ended.
      </EmptyState>
    </div>
  );
}

function NoTrack({ error, loading }: { error: unknown; loading: boolean }) {
  if (loading) return <Loader m="xl" />;
  return <Reasons tone="warn" reasons={error ? sentences(error) : ["This run has no recorded track: it ended before the robot moved."]} />;
}

function Replay({ run, track }: { run: RunDetail; track: RunTrack }) {
  const end = track.t_s.at(-1) ?? 0;
  const playback = usePlayback(end);
  const { t } = playback;
  const index = indexAt(track.t_s, t);
  const [site, vehicle] = [useQuery(siteQuery(run.site_id)).data, useQuery(robotQuery).data?.vehicle];
  const pose = useMemo(() => ({ x: track.x[index]!, y: track.y[index]!, yaw: track.yaw[index]! }), [track, index]);
  return (
    <>
      <ReplayMap run={run} track={track} pose={pose} vehicle={vehicle} site={site} />
      <ReplayBar playback={playback} track={track} index={index} end={end} />
      <aside className={css.side}>
        <ReplayCamera runId={run.id} track={track} t={t} />
        <RunPlots track={track} t={t} onPick={playback.seek} />
        <RunSwitches run={run} track={track} onPick={playback.seek} />
      </aside>
    </>
  );
}
