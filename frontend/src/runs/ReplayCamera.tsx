import { keepPreviousData, useQuery } from "@tanstack/react-query";
import { useCallback, useEffect, useRef } from "react";

import { request } from "../api/client";
import type { CameraView, RunTrack } from "../api/types";
import { CameraCanvas } from "../camera/CameraCanvas";
import { LayerChips } from "../camera/LayerChips";
import css from "../camera/camera.module.css";
import type { Picture } from "../camera/painter";
import { useLayers } from "../camera/useLayers";
import { indexAt } from "../plots/bands";

/** A picture further away in time than this says nothing about the moment looked at, s. */
const NEAR = 1;

async function fetchPicture(runId: string, t: number, signal: AbortSignal): Promise<Picture<CameraView>> {
  const response = await request("GET", `/api/runs/${runId}/camera?t_s=${t}`, undefined, signal);
  const view = JSON.parse(response.headers.get("X-Camera-View") ?? "null") as CameraView;
  return { view, jpeg: await response.blob() };
}

/** The camera at the moment looked at, with what was seen then. */
export function ReplayCamera({ runId, track, t }: { runId: string; track: RunTrack; t: number }) {
  const taken = track.camera_t_s[indexAt(track.camera_t_s, t)];
  const near = taken !== undefined && Math.abs(taken - t) <= NEAR;
  const { data } = useQuery({
    queryKey: ["picture", runId, taken],
    queryFn: ({ signal }) => fetchPicture(runId, taken!, signal),
    enabled: near,
    placeholderData: keepPreviousData,
    staleTime: Infinity,
    gcTime: 20_000,
  });
  const [layers, setLayers] = useLayers();
  const feed = useFeed(data);
  return (
    <section>
      <div className={css.frame}>
        <CameraCanvas feed={feed} layers={layers} />
        {!near && <div className={css.note}>No picture at this moment: the camera is recorded in and before rows</div>}
        {near && data && <span className={css.corner}>{data.view.camera === "rear" ? "Rear" : "Front"} camera</span>}
      </div>
      <LayerChips layers={layers} onChange={setLayers} />
    </section>
  );
}

/** Hands each new picture to the canvas. */
function useFeed(picture: Picture<CameraView> | undefined) {
  const sink = useRef<((picture: Picture<CameraView>) => void) | null>(null);
  const newest = useRef(picture);
  newest.current = picture;
  useEffect(() => {
    if (picture) sink.current?.(picture);
  }, [picture]);
  return useCallback((show: (picture: Picture<CameraView>) => void) => {
    sink.current = show;
    if (newest.current) show(newest.current);
    return () => {
      sink.current = null;
    };
  }, []);
}
