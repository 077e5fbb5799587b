import { Button } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { IconTrees } from "@tabler/icons-react";

import { post, sentences } from "../api/client";
import type { RunDetail, TrunksMapped } from "../api/types";
import { Reasons } from "../ui/Reasons";

/** Takes an older run into the trunk map; newer ones are taken in when they end. */
export function MapTrunks({ run }: { run: RunDetail }) {
  const client = useQueryClient();
  const mapping = useMutation({
    mutationFn: () => post<TrunksMapped>(`/api/runs/${run.id}/trunks`),
    onSuccess: () => client.invalidateQueries({ queryKey: ["trunks"] }),
  });
  if (run.site_id === null || run.log_bytes === null || run.ended === null) return null;
  return (
    <>
      <Button variant="default" leftSection={<IconTrees size={18} />} loading={mapping.isPending} onClick={() => mapping.mutate()}>
        Map the trunks
      </Button>
      {mapping.isPending && <span role="status">Reading the run, up to a minute</span>}
      {mapping.data && <span role="status">{mapping.data.message}</span>}
      {mapping.error && <Reasons reasons={sentences(mapping.error)} />}
    </>
  );
}
