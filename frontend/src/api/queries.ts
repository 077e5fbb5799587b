/** What the pages read from the station, cached by TanStack Query. */
import { keepPreviousData, queryOptions } from "@tanstack/react-query";

import { get, post } from "./client";
import type { Job, Map3d, Mission, MissionDocument, Preview, Robot, RunDetail, RunDocument, RunMap3d, RunTrack, SiteDocument, SiteSummary, TrunkMap } from "./types";

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

export const runsQuery = queryOptions({
  queryKey: ["runs"],
  queryFn: ({ signal }) => get<RunDocument[]>("/api/runs", signal),
  refetchInterval: 5000,
});

export const runQuery = (id: string) =>
  queryOptions({ queryKey: ["run", id], queryFn: ({ signal }) => get<RunDetail>(`/api/runs/${id}`, signal) });

export const trackQuery = (id: string) =>
  queryOptions({
    queryKey: ["track", id],
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

/** Of a farm, the newest first. */
export const maps3dQuery = (siteId: string) =>
  queryOptions({ queryKey: ["maps3d", siteId], queryFn: ({ signal }) => get<Map3d[]>(`/api/sites/${siteId}/maps3d`, signal) });
