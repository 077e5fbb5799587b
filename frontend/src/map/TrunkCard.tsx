import { Button, CloseButton, Menu, Paper } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";
import { useMutation } from "@tanstack/react-query";

import { remove } from "../api/client";
import type { Trunk } from "../api/types";
import { notifyDone } from "../ui/notify";
import { TrunkMenu } from "./TrunkMenu";
import { trunkWords } from "./trunkFeatures";
import css from "./trunks.module.css";
import { useTrunksChanged } from "./useTrunkFile";

interface Props {
  siteId: string;
  trunk: Trunk;
  onDrive?: (rowId: string, trunkId: string) => void;
  onClose: () => void;
}

/** What is known of one trunk, and what can be done with it. */
export function TrunkCard({ siteId, trunk, onDrive, onClose }: Props) {
  const [address] = trunk.addresses;
  const erase = useErase(siteId, trunk, onClose);
  const drive = () => {
    onDrive?.(address!.row_id, trunk.id);
    onClose();
  };
  return (
    <Paper className={css.card} shadow="md" p="sm">
      <b>{trunkWords(trunk)}</b>
      {onDrive && address && (
        <Button size="lg" className={css.go} onClick={drive}>
          Drive to this trunk
        </Button>
      )}
      <TrunkMenu siteId={siteId} onDeleted={onClose}>
        <Menu.Item color="red" leftSection={<IconTrash size={20} />} disabled={erase.isPending} onClick={() => erase.mutate()}>
          Take this trunk off the map …
        </Menu.Item>
      </TrunkMenu>
      <CloseButton size="xl" onClick={onClose} aria-label="Close" />
    </Paper>
  );
}

function useErase(siteId: string, trunk: Trunk, onErased: () => void) {
  const changed = useTrunksChanged(siteId);
  return useMutation({
    mutationFn: async () => {
      if (!window.confirm(`Take “${trunkWords(trunk)}” off the map? A run that sees it again puts it back.`)) return false;
      await remove(`/api/sites/${siteId}/trunks/${encodeURIComponent(trunk.id)}`);
      return true;
    },
    onSuccess: (erased) => {
      if (!erased) return;
      changed();
      notifyDone("The trunk is off the map.");
      onErased();
    },
  });
}
