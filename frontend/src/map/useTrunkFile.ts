import { useMutation, useQueryClient } from "@tanstack/react-query";

import { put, remove } from "../api/client";
import type { TrunkMap } from "../api/types";
import { readJson } from "../api/readJson";
import { notifyDone } from "../ui/notify";

/** To be called when the station's map of trunks is another one. */
export function useTrunksChanged(siteId: string) {
  const client = useQueryClient();
  return () => void client.invalidateQueries({ queryKey: ["trunks", siteId] });
}

/** Puts a file in the place of the map, or throws the map away; both ask first where something would be lost. */
export function useTrunkFile(siteId: string, onDeleted: () => void) {
  const changed = useTrunksChanged(siteId);
  const load = useMutation({
    mutationFn: async (file: File) => put<TrunkMap>(`/api/sites/${siteId}/trunks/geojson`, await readJson(file)),
    onSuccess: (map) => {
      changed();
      notifyDone(`The map has ${map.trunks.length} trunks now.`);
    },
  });
  const clear = useMutation({
    mutationFn: () => remove(`/api/sites/${siteId}/trunks`),
    onSuccess: () => {
      changed();
      notifyDone("The map of trunks is empty. Runs can be mapped again on their own page.");
      onDeleted();
    },
  });
  return { load, clear };
}
