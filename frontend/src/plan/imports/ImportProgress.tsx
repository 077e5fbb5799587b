import { Button, Modal, Progress } from "@mantine/core";
import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useEffect, useState } from "react";
import { useLocation } from "wouter";

import { sentences } from "../../api/client";
import { jobQuery } from "../../api/queries";
import { upload } from "../../api/upload";
import { bytes } from "../../ui/format";
import { Reasons } from "../../ui/Reasons";

const ALL = 100;

/** First the way of the file to the station, then what is made of it. */
export function ImportProgress({ file, path, onClose }: { file: File; path: string; onClose: () => void }) {
  const { jobId, sent, error } = useUpload(file, path);
  const job = useQuery(jobQuery(jobId)).data;
  useArrival(job?.state === "done" ? job.site_id : null, onClose);
  const failed = error ?? (job?.state === "failed" ? [job.message] : null);
  return (
    <Modal opened onClose={onClose} withCloseButton={false} closeOnClickOutside={false} title={<b>Importing {file.name}</b>}>
      {failed ? <Reasons reasons={failed} /> : <Step jobMessage={job?.message} progress={jobId ? (job?.progress ?? 0) : sent} size={file.size} />}
      <Button mt="md" variant="default" fullWidth onClick={onClose}>
        {failed ? "Close" : "Go on in the background"}
      </Button>
    </Modal>
  );
}

function Step({ jobMessage, progress, size }: { jobMessage: string | undefined; progress: number; size: number }) {
  return (
    <>
      <p>{jobMessage ?? `Sending ${bytes(size)} to the station`}</p>
      <Progress value={progress * ALL} size="xl" aria-label="Progress" animated />
    </>
  );
}

function useUpload(file: File, path: string) {
  const [jobId, setJobId] = useState<string | null>(null);
  const [sent, setSent] = useState(0);
  const [error, setError] = useState<string[] | null>(null);
  useEffect(() => {
    let wanted = true;
    const whenWanted = <T,>(act: (value: T) => void) => (value: T) => void (wanted && act(value));
    // The next tick, so that a component that is mounted twice in development sends the file once.
    const timer = setTimeout(() => {
      upload<{ job_id: string }>(`${path}?name=${encodeURIComponent(file.name)}`, file, whenWanted(setSent)).then(
        whenWanted(({ job_id }: { job_id: string }) => setJobId(job_id)),
        whenWanted((failure: unknown) => setError(sentences(failure))),
      );
    });
    return () => {
      wanted = false;
      clearTimeout(timer);
    };
  }, [file, path]);
  return { jobId, sent, error };
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
