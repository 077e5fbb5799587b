import { useMutation, useQuery } from "@tanstack/react-query";
import { useEffect } from "react";

import { post, sentences } from "../../api/client";
import { jobQuery } from "../../api/queries";
import type { Map3d } from "../../api/types";
import { mapWords } from "../../map/map3d/shownMap";
import { ImportModal } from "../imports/ImportModal";

/** Looks for rows in a map that the station has already. */
export function OwnMapProgress({ siteId, map, onClose }: { siteId: string; map: Map3d; onClose: () => void }) {
  const begin = useMutation({ mutationFn: () => post<{ job_id: string }>(`/api/sites/${siteId}/found-rows/of-run/${map.run_id}`) });
  useEffect(() => {
    // The next tick, so that a component that is mounted twice in development asks once.
    const timer = setTimeout(() => begin.mutate());
    return () => clearTimeout(timer);
  }, [siteId, map.run_id]);
  const job = useQuery(jobQuery(begin.data?.job_id ?? null)).data;
  return <ImportModal title={`Rows from the 3D map of ${mapWords(map)}`} before="Asking the station" beforeDone={0} job={job} error={begin.error ? sentences(begin.error) : null} onClose={onClose} />;
}
