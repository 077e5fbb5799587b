import { Button } from "@mantine/core";
import { IconHomeMove } from "@tabler/icons-react";
import { useMutation, useQuery } from "@tanstack/react-query";

import { robotQuery, standOnSite } from "../api/queries";
import type { SiteDocument } from "../api/types";
import { distance } from "../geo/measure";
import { useTopic } from "../live/hooks";
import { START_REACH } from "../ui/readiness";

/** A simulated robot that stands in the field can simply be put back; a real one must be driven. */
export function BackToWarehouse({ document }: { document: SiteDocument }) {
  const simulated = useQuery(robotQuery).data?.simulated;
  const pose = useTopic("nav/status")?.pose;
  const move = useMutation({ mutationFn: () => standOnSite(document.id) });
  const { warehouse } = document.site;
  if (!simulated || !warehouse || !pose || distance([pose.x, pose.y], [warehouse.x, warehouse.y]) < START_REACH) return null;
  return (
    <Button size="lg" variant="default" leftSection={<IconHomeMove size={24} />} loading={move.isPending} onClick={() => move.mutate()}>
      Back to the warehouse
    </Button>
  );
}
