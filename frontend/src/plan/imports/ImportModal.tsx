import { Button, Modal, Progress } from "@mantine/core";
import { useQueryClient } from "@tanstack/react-query";
import { type ReactNode, useEffect } from "react";
import { useLocation } from "wouter";

import type { Job } from "../../api/types";
import { Reasons } from "../../ui/Reasons";

const ALL = 100;

interface Props {
  title: ReactNode;
  /** Before the station has begun. */
  before: string;
  /** Of what goes before, 0 to 1. */
  beforeDone: number;
  job: Job | undefined;
  error: string[] | null;
  onClose: () => void;
}

/** How a job of the station goes; the site's page opens when it is done. */
export function ImportModal({ title, before, beforeDone, job, error, onClose }: Props) {
  useArrival(job?.state === "done" ? job.site_id : null, onClose);
  const failed = error ?? (job?.state === "failed" ? [job.message] : null);
  return (
    <Modal opened onClose={onClose} withCloseButton={false} closeOnClickOutside={false} title={<b>{title}</b>}>
      {failed ? (
        <Reasons reasons={failed} />
      ) : (
        <>
          <p>{job?.message ?? before}</p>
          <Progress value={(job?.progress ?? beforeDone) * ALL} size="xl" aria-label="Progress" animated />
        </>
      )}
      <Button mt="md" variant="default" fullWidth onClick={onClose}>
        {failed ? "Close" : "Go on in the background"}
      </Button>
    </Modal>
  );
}

/** Opens the site when it is there. */
function useArrival(siteId: string | null | undefined, onClose: () => void): void {
  const client = useQueryClient();
  const [, go] = useLocation();
  useEffect(() => {
    if (!siteId) return;
    void client.invalidateQueries({ queryKey: ["sites"] });
    void client.invalidateQueries({ queryKey: ["site", siteId] });
    void client.invalidateQueries({ queryKey: ["found-rows", siteId] });
    go(`/plan/${siteId}`);
    onClose();
  }, [siteId]);
}
