/** What the pages read from the station, cached by TanStack Query. */
import { keepPreviousData, queryOptions } from "@tanstack/react-query";

import { get, post } from "./client";
import type { CalibrationDocument, Job, Map3d, Map3dChoice, Map3dPicture, Mission, MissionDocument, Preview, Robot, RowProposal, RunDetail, RunDocument, RunMap3d, RunTrack, SiteDocument, SiteSummary, TrunkMap, VersionDocument } from "./types";

export const sitesQuery = queryOptions({ queryKey: ["sites"], queryFn: ({ signal }) => get<SiteSummary[]>("/api/sites", signal) });

export const siteQuery = (id: string | null | undefined) =>
  queryOptions({
    queryKey: ["site", id],
    queryFn: ({ signal }) => get<SiteDocument>(`/api/sites/${id}`, signal),
    enabled: Boolean(id),
  });

export const missionsQuery = (siteId: string | null | undefined) =>
  queryOptions({
    queryKey: ["missions", siteId],
    queryFn: ({ signal }) => get<MissionDocument[]>(`/api/sites/${siteId}/missions`, signal),
    enabled: Boolean(siteId),
  });

/** A run that has ended is mapped half a minute later, and nobody tells the page. */
export const trunksQuery = (siteId: string) =>
  queryOptions({
    queryKey: ["trunks", siteId],
    queryFn: ({ signal }) => get<TrunkMap>(`/api/sites/${siteId}/trunks`, signal),
    refetchInterval: 30_000,
  });

/** What was found in a 3D map and waits to be accepted; null if nothing waits. It may come while nobody watches it. */
export const rowProposalQuery = (siteId: string) =>
  queryOptions({
    queryKey: ["found-rows", siteId],
    queryFn: ({ signal }) => get<RowProposal | null>(`/api/sites/${siteId}/found-rows`, signal),
    refetchInterval: 10_000,
  });

/** The plan that would be driven. `revision` makes a changed site count as a changed question. */
export const previewQuery = (siteId: string | undefined, mission: Mission | null, revision: number) =>
  queryOptions({
    queryKey: ["preview", siteId, revision, mission],
    queryFn: () => post<Preview>(`/api/sites/${siteId}/preview`, { mission }),
    enabled: Boolean(siteId && mission),
    placeholderData: keepPreviousData,
    staleTime: 60_000,
  });

export const robotQuery = queryOptions({
  queryKey: ["robot"],
  queryFn: ({ signal }) => get<Robot>("/api/robot", signal),
  refetchInterval: 3000,
});

/** Puts the simulated robot at the warehouse of a site. */
export const standOnSite = (site_id: string) => post<Robot>("/api/robot/site", { site_id });

export const jobQuery = (id: string | null) =>
  queryOptions({
    queryKey: ["job", id],
    queryFn: ({ signal }) => get<Job>(`/api/jobs/${id}`, signal),
    enabled: id !== null,
    refetchInterval: (query) => (query.state.data === undefined || query.state.data.state === "running" ? 500 : false),
  });

/** Asking for it keeps its process running, so it is asked for as long as the page is open. */
export const calibrationQuery = queryOptions({
  queryKey: ["calibration"],
  queryFn: ({ signal }) => get<CalibrationDocument>("/api/calibration", signal),
  refetchInterval: 1500,
});

export const versionsQuery = queryOptions({
  queryKey: ["calibration-versions"],
  queryFn: ({ signal }) => get<VersionDocument[]>("/api/calibration/versions", signal),
  refetchInterval: 10_000, // a command may have put one there
});

export const runsQuery = queryOptions({
  queryKey: ["runs"],
  queryFn: ({ signal }) => get<RunDocument[]>("/api/runs", signal),
  refetchInterval: 5000,
});

/** Asked again while the robot still drives. */
export const runQuery = (id: string) =>
  queryOptions({
    queryKey: ["run", id],
    queryFn: ({ signal }) => get<RunDetail>(`/api/runs/${id}`, signal),
    refetchInterval: ({ state }) => (state.data && state.data.ended === null ? 3_000 : false),
  });

/** What is recorded so far; of a run that has `ended`, the whole. */
export const trackQuery = (id: string, ended: string | null) =>
  queryOptions({
    queryKey: ["track", id, ended],
    queryFn: ({ signal }) => get<RunTrack>(`/api/runs/${id}/track`, signal),
    staleTime: 30_000,
  });

/** Of a run; asked again while it is made. */
export const runMap3dQuery = (runId: string) =>
  queryOptions({
    queryKey: ["map3d", runId],
    queryFn: ({ signal }) => get<RunMap3d>(`/api/runs/${runId}/map3d`, signal),
    refetchInterval: (query) => (query.state.data?.job?.state === "running" ? 1000 : false),
  });

/** Which 3D map the robot drives by on a farm. */
export const map3dInUseQuery = (siteId: string) =>
  queryOptions({ queryKey: ["maps3d", siteId, "in use"], queryFn: ({ signal }) => get<Map3dChoice>(`/api/sites/${siteId}/map3d/in_use`, signal) });

/** Of a farm, the newest first. */
export const maps3dQuery = (siteId: string) =>
  queryOptions({ queryKey: ["maps3d", siteId], queryFn: ({ signal }) => get<Map3d[]>(`/api/sites/${siteId}/maps3d`, signal) });

/** A map seen from above; the station draws it when it is first asked for. Made anew, it is another one. */
export const map3dPictureQuery = (siteId: string, map: Map3d | null) =>
  queryOptions({
    queryKey: ["map3d-picture", siteId, map?.run_id, map?.made],
    queryFn: ({ signal }) => get<Map3dPicture>(`/api/sites/${siteId}/maps3d/${map?.run_id}/picture`, signal),
    enabled: map?.georeferenced === true,
    staleTime: Infinity,
  });
