import { Button, Group } from "@mantine/core";
import { useMutation, useQueryClient } from "@tanstack/react-query";

import { remove } from "../../api/client";
import { rowProposalQuery } from "../../api/queries";
import type { RowProposal } from "../../api/types";
import { Card } from "../../ui/Card";
import { notifyDone } from "../../ui/notify";
import { Reasons } from "../../ui/Reasons";
import css from "../plan.module.css";
import type { SiteEditing } from "../useSiteEditor";
import { foundInWords, withFound } from "./withFound";

/** Asks whether what was found shall become part of the farm. Accepting is one step of drawing: it can be undone. */
export function ProposalCard({ siteId, found, editing }: { siteId: string; found: RowProposal; editing: SiteEditing }) {
  const client = useQueryClient();
  const forget = useMutation({
    mutationFn: () => remove(`/api/sites/${siteId}/found-rows`),
    onSuccess: () => client.setQueryData(rowProposalQuery(siteId).queryKey, null),
  });
  const accept = () => {
    editing.commit(withFound(editing.site, found));
    notifyDone(`${foundInWords(found)} added. “Undo” takes them back.`);
    forget.mutate();
  };
  const empty = found.rows.length === 0;
  return (
    <Card title={empty ? "No rows found" : "Found in the 3D map"}>
      <div className={css.stack}>
        <p className={css.quiet}>{found.file_name}</p>
        {!empty && <b>{foundInWords(found)}</b>}
        <Reasons reasons={found.notes} tone="quiet" />
        <Group grow>
          <Button size="lg" variant="default" loading={forget.isPending} onClick={() => forget.mutate()}>
            Throw away
          </Button>
          {!empty && (
            <Button size="lg" disabled={forget.isPending} onClick={accept}>
              Accept
            </Button>
          )}
        </Group>
      </div>
    </Card>
  );
}
