import { Button } from "@mantine/core";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { IconRoute, IconRouteOff } from "@tabler/icons-react";

import { put, sentences } from "../api/client";
import { map3dInUseQuery } from "../api/queries";
import type { Map3d, Map3dChoice } from "../api/types";
import { Reasons } from "../ui/Reasons";

/** Lets the robot drive by a map where GNSS and rows tell nothing, or by none. */
export function UseMap3d({ siteId, map }: { siteId: string; map: Map3d }) {
  const client = useQueryClient();
  const inUse = useQuery(map3dInUseQuery(siteId)).data?.run_id === map.run_id;
  const choose = useMutation({
    mutationFn: (run_id: string | null) => put<Map3dChoice>(`/api/sites/${siteId}/map3d/in_use`, { run_id }),
    onSuccess: (now) => client.setQueryData(map3dInUseQuery(siteId).queryKey, now),
  });
  const Glyph = inUse ? IconRouteOff : IconRoute;
  return (
    <>
      <span role="status">{inUse ? "The robot drives by this map where GNSS and rows tell too little." : "The robot does not drive by this map."}</span>
      <Button size="md" variant={inUse ? "default" : "filled"} leftSection={<Glyph size={20} />} disabled={!map.georeferenced} loading={choose.isPending} onClick={() => choose.mutate(inUse ? null : map.run_id)}>
        {inUse ? "Stop driving by it" : "Drive by this map"}
      </Button>
      {choose.error && <Reasons reasons={sentences(choose.error)} />}
    </>
  );
}
