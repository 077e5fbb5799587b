import { Button } from "@mantine/core";
import { IconTractor } from "@tabler/icons-react";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";

import { robotQuery, standOnSite } from "../../api/queries";
import { notifyDone } from "../../ui/notify";
import { isUnderWay } from "../../ui/words";
import type { SiteEditing } from "../useSiteEditor";

/** Puts the simulated robot on this farm as it is drawn now. */
export function SimulateButton({ siteId, editing }: { siteId: string; editing: SiteEditing }) {
  const client = useQueryClient();
  const robot = useQuery(robotQuery).data;
  const move = useMutation({
    mutationFn: async () => {
      await editing.autosave.flush();
      return standOnSite(siteId);
    },
    onSuccess: () => {
      void client.invalidateQueries({ queryKey: ["robot"] });
      notifyDone("The simulated robot stands on this farm. Go to Drive.");
    },
  });
  if (!robot?.simulated) return null;
  const here = robot.site_id === siteId;
  return (
    <Button variant={here ? "default" : "filled"} leftSection={<IconTractor size={22} />} loading={move.isPending} disabled={isUnderWay(robot.state) || !editing.site.warehouse} onClick={() => move.mutate()}>
      {here ? "Restart the simulator here" : "Simulate this farm"}
    </Button>
  );
}
