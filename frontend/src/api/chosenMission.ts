import { skipToken, useQuery, useQueryClient } from "@tanstack/react-query";

/** The mission that was last opened, saved or chosen on a farm, on whichever page; null before the first. */
export function useChosenMission(siteId: string): [string | null, (id: string) => void] {
  const client = useQueryClient();
  const queryKey = ["chosen mission", siteId];
  const chosen = useQuery<string | null>({ queryKey, queryFn: skipToken, initialData: null, staleTime: Infinity, gcTime: Infinity });
  return [chosen.data ?? null, (id) => client.setQueryData(queryKey, id)];
}
