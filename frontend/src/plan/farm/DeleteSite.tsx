import { Button, Group, Modal } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";
import { useLocation } from "wouter";

import { remove } from "../../api/client";
import type { SiteDocument } from "../../api/types";

export function DeleteSite({ opened, onClose, document }: { opened: boolean; onClose: () => void; document: SiteDocument }) {
  const client = useQueryClient();
  const [, go] = useLocation();
  const erase = useMutation({
    mutationFn: () => remove(`/api/sites/${document.id}`),
    onSuccess: async () => {
      await client.invalidateQueries({ queryKey: ["sites"] });
      go("/plan");
    },
    onSettled: onClose,
  });
  return (
    <Modal opened={opened} onClose={onClose} title={<b>Delete “{document.name}”?</b>}>
      <p>The farm, its picture and its missions are deleted. Runs that were driven on it stay. Export it as GeoJSON first if you may need it again.</p>
      <Group grow>
        <Button variant="default" onClick={onClose} data-autofocus>
          Keep it
        </Button>
        <Button color="red" loading={erase.isPending} onClick={() => erase.mutate()}>
          Delete it
        </Button>
      </Group>
    </Modal>
  );
}
