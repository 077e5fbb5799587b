import { useMutation, useQueryClient } from "@tanstack/react-query";

import { post } from "../api/client";
import { missionsQuery } from "../api/queries";
import type { Mission, MissionDocument } from "../api/types";
import { notifyDone } from "../ui/notify";

interface Target {
  row_id: string;
  stop_at: string;
}

/** Chooses the mission to a trunk, made now if there is none yet; it is started like any other. */
export function useDriveToTrunk(siteId: string, onMission: (id: string) => void) {
  const client = useQueryClient();
  const choose = useMutation({
    mutationFn: async (target: Target) => (await known(target)) ?? (await made(target)),
    onSuccess: ({ id, name }) => {
      void client.invalidateQueries({ queryKey: ["missions"] });
      onMission(id);
      notifyDone(`“${name}” is chosen. Press Start to drive there.`);
    },
  });
  const known = async (target: Target) => (await client.fetchQuery(missionsQuery(siteId))).find((stored) => leadsTo(stored.mission, target));
  const made = async (target: Target) => {
    const mission = await post<Mission>(`/api/sites/${siteId}/missions/for-row`, { exit: "reverse", ...target });
    return post<MissionDocument>(`/api/sites/${siteId}/missions`, { mission });
  };
  return (row_id: string, stop_at: string) => choose.mutate({ row_id, stop_at });
}

/** Whether a mission goes to this trunk and nowhere else. */
export function leadsTo(mission: Mission, { row_id, stop_at }: Target): boolean {
  const [visit] = mission.visits;
  return mission.visits.length === 1 && visit?.row_id === row_id && visit.stop_at === stop_at;
}
