import { useLocalStorage } from "@mantine/hooks";
import { useQuery } from "@tanstack/react-query";
import { useState } from "react";

import { sentences } from "../../api/client";
import { map3dInUseQuery, map3dPictureQuery, maps3dQuery } from "../../api/queries";
import type { Map3d, Map3dPicture } from "../../api/types";
import { NO_PLACE, shownMap } from "./shownMap";

export interface Map3dView {
  /** Of the farm, the newest first. */
  maps: readonly Map3d[];
  shown: boolean;
  map: Map3d | null;
  /** Once the station has drawn it. */
  picture: Map3dPicture | null;
  /** Why it cannot be drawn. */
  problems: readonly string[];
  show: (shown: boolean) => void;
  choose: (runId: string) => void;
}

/** Which 3D map lies over the farm, if one does: the operator's choice, kept in this browser; else where no photo is. */
export function useMap3dView(siteId: string, hasPhoto: boolean): Map3dView {
  const [wanted, show] = useLocalStorage<boolean | null>({ key: "rowpilot.map3d", defaultValue: null, getInitialValueInEffect: false });
  const [chosen, choose] = useState<string | null>(null);
  const maps = useQuery(maps3dQuery(siteId)).data ?? [];
  const inUse = useQuery(map3dInUseQuery(siteId)).data?.run_id ?? null;
  const map = shownMap(maps, chosen, inUse);
  const shown = map !== null && (wanted ?? (map.georeferenced && !hasPhoto));
  const drawn = useQuery(map3dPictureQuery(siteId, shown ? map : null));
  return { maps, shown, map, picture: (shown && drawn.data) || null, problems: problemsOf(map, drawn.error), show, choose };
}

function problemsOf(map: Map3d | null, error: unknown): readonly string[] {
  if (map && !map.georeferenced) return [NO_PLACE];
  return error ? sentences(error) : [];
}
