import { Button, Progress } from "@mantine/core";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { IconBox, IconPlayerStop } from "@tabler/icons-react";

import { post, remove, sentences } from "../api/client";
import { runMap3dQuery } from "../api/queries";
import type { Map3dJob, RunDetail, RunMap3d } from "../api/types";
import { Reasons } from "../ui/Reasons";
import { Map3dResult } from "./Map3dResult";
import { SiteMaps3d } from "./SiteMaps3d";
import css from "./runs.module.css";

const ALL = 100;

/** The 3D map of a run: made, followed, stopped, taken home; nothing for a robot without a 3D LiDAR. */
export function Map3d({ run }: { run: RunDetail }) {
  const state = useQuery({ ...runMap3dQuery(run.id), enabled: run.site_id !== null && run.ended !== null });
  if (run.site_id === null || run.ended === null) return null;
  if (state.error) return <Reasons reasons={sentences(state.error)} />;
  if (!state.data || (state.data.clouds === 0 && !state.data.map)) return null;
  const { job, map } = state.data;
  return (
    <section className={css.map3d} aria-label="3D map">
      <h2>3D map</h2>
      {job?.state === "running" ? <Making runId={run.id} job={job} /> : <Make run={run} state={state.data} />}
      {map && job?.state !== "running" && <Map3dResult siteId={run.site_id} map={map} />}
      <SiteMaps3d siteId={run.site_id} runId={run.id} />
    </section>
  );
}

function Make({ run, state }: { run: RunDetail; state: RunMap3d }) {
  const client = useQueryClient();
  const start = useMutation({
    mutationFn: () => post<RunMap3d>(`/api/runs/${run.id}/map3d`),
    onSuccess: (now) => client.setQueryData(["map3d", run.id], now),
  });
  const failed = start.error ? sentences(start.error) : state.job?.state === "failed" ? [state.job.message] : [];
  const again = state.begun ? "Go on with the 3D map" : "Make the 3D map";
  return (
    <>
      <Reasons reasons={failed} tone={state.begun && !start.error ? "warn" : "bad"} />
      {!state.map && (
        <>
          <Button size="md" leftSection={<IconBox size={20} />} loading={start.isPending} disabled={run.log_bytes === null} onClick={() => start.mutate()}>
            {again}
          </Button>
          <span>{clouds(state.clouds)} Takes about as long as the drive did; the station can be used meanwhile.</span>
        </>
      )}
    </>
  );
}

const clouds = (count: number | null) => (count === null ? "" : `${count} clouds.`);

function Making({ runId, job }: { runId: string; job: Map3dJob }) {
  const client = useQueryClient();
  const stop = useMutation({
    mutationFn: () => remove(`/api/runs/${runId}/map3d/job`),
    onSettled: () => client.invalidateQueries({ queryKey: ["map3d", runId] }),
  });
  return (
    <>
      <span role="status">
        {Math.floor(job.progress * ALL)} % · {job.message}
      </span>
      <Progress value={job.progress * ALL} size="xl" aria-label="Progress of the 3D map" animated />
      {stop.error && <Reasons reasons={sentences(stop.error)} />}
      <Button size="md" variant="default" leftSection={<IconPlayerStop size={20} />} loading={stop.isPending} onClick={() => stop.mutate()}>
        Stop, and keep what is done
      </Button>
    </>
  );
}
