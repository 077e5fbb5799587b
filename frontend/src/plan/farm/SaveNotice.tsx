import { Button, Group } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";

import { siteQuery } from "../../api/queries";
import { Badge } from "../../ui/Badge";
import { Reasons } from "../../ui/Reasons";
import type { SiteEditing } from "../useSiteEditor";

/** Says whether the drawing is on disk; asks where someone else has changed it meanwhile. */
export function SaveNotice({ editing, siteId, onReload }: { editing: SiteEditing; siteId: string; onReload: () => void }) {
  const { saving } = editing;
  switch (saving.kind) {
    case "saved":
      return <Badge tone="good">All changes saved</Badge>;
    case "waiting":
    case "saving":
      return <Badge tone="busy">Saving …</Badge>;
    case "offline":
      return <Reasons reasons={["The station cannot be reached. Your changes stay here and are saved as soon as it answers."]} tone="warn" />;
    case "refused":
      return <Reasons reasons={["Not saved yet:", ...saving.reasons]} />;
    case "conflict":
      return <Conflict editing={editing} siteId={siteId} onReload={onReload} />;
  }
}

function Conflict({ editing, siteId, onReload }: { editing: SiteEditing; siteId: string; onReload: () => void }) {
  const client = useQueryClient();
  const keepMine = useMutation({
    mutationFn: async () => {
      const theirs = await client.fetchQuery({ ...siteQuery(siteId), staleTime: 0 });
      await editing.autosave.overwrite(theirs.version);
    },
  });
  return (
    <div>
      <Reasons reasons={["This farm was changed in another window. Choose which drawing to keep."]} tone="warn" />
      <Group grow mt="xs">
        <Button variant="default" onClick={onReload}>
          Load theirs
        </Button>
        <Button loading={keepMine.isPending} onClick={() => keepMine.mutate()}>
          Keep mine
        </Button>
      </Group>
    </div>
  );
}
