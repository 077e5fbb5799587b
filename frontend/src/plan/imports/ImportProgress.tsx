import { useQuery } from "@tanstack/react-query";
import { useEffect, useState } from "react";

import { sentences } from "../../api/client";
import { jobQuery } from "../../api/queries";
import { upload } from "../../api/upload";
import { bytes } from "../../ui/format";
import { ImportModal } from "./ImportModal";

/** First the way of the file to the station, then what is made of it. */
export function ImportProgress({ file, path, onClose }: { file: File; path: string; onClose: () => void }) {
  const { jobId, sent, error } = useUpload(file, path);
  const job = useQuery(jobQuery(jobId)).data;
  return <ImportModal title={`Importing ${file.name}`} before={`Sending ${bytes(file.size)} to the station`} beforeDone={jobId ? 0 : sent} job={job} error={error} onClose={onClose} />;
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
