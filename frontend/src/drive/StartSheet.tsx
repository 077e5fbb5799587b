import { Button, Loader, Modal, Radio } from "@mantine/core";
import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";

import { get, post, sentences } from "../api/client";
import type { LinkLossPolicy, MissionDocument, Preview, RunDocument, SiteDocument } from "../api/types";
import { useFresh, useTopic } from "../live/hooks";
import { duration, way } from "../ui/format";
import { HoldButton } from "../ui/HoldButton";
import { Reasons } from "../ui/Reasons";
import { startHindrances } from "../ui/readiness";
import { rowWords } from "../ui/words";
import css from "./drive.module.css";

const NONCE_REFRESH_MS = 10_000;

interface Props {
  opened: boolean;
  onClose: () => void;
  document: SiteDocument;
  mission: MissionDocument;
  preview: Preview | undefined;
}

/** The second step of a start: what will happen, every reason against it, and a button that must be held. */
export function StartSheet({ opened, onClose, ...rest }: Props) {
  return (
    <Modal opened={opened} onClose={onClose} title={<b>Start “{rest.mission.name}”</b>}>
      <Sheet onClose={onClose} {...rest} />
    </Modal>
  );
}

function Sheet({ onClose, document, mission, preview }: Omit<Props, "opened">) {
  const [linkLoss, setLinkLoss] = useState<LinkLossPolicy>("continue");
  const start = useStart(mission.id, linkLoss, onClose);
  const hindrances = useHindrances(preview);
  const refused = start.error ? sentences(start.error).filter((sentence) => !hindrances.includes(sentence)) : [];
  return (
    <div className={css.sheet}>
      <Summary document={document} mission={mission} preview={preview} />
      <LinkLoss value={linkLoss} onChange={setLinkLoss} />
      <Reasons reasons={["The robot will move by itself. Make sure that nobody is in its way. Its own emergency stop comes before this page."]} tone="warn" />
      <Reasons reasons={[...hindrances, ...refused]} />
      <HoldButton disabled={hindrances.length > 0 || !preview?.plan || start.isPending} onHeld={() => start.mutate()}>
        {start.isPending ? "Starting …" : hindrances.length > 0 ? "Cannot start yet" : "Hold to start"}
      </HoldButton>
      <Button variant="default" size="lg" fullWidth onClick={onClose} data-autofocus>
        Cancel
      </Button>
    </div>
  );
}

/** Everything that stands against the start as long as it lasts: in the plan, in the robot, in the link. */
function useHindrances(preview: Preview | undefined): string[] {
  const status = useTopic("nav/status");
  const fresh = useFresh("nav/status");
  const ofRobot = status && fresh ? startHindrances(status, preview?.plan ?? null) : ["The data from the robot are older than one second. Wait for the link."];
  return [...(preview?.problems ?? []), ...ofRobot];
}

function useStart(mission_id: string, link_loss: LinkLossPolicy, onStarted: () => void) {
  const client = useQueryClient();
  const nonce = useQuery({
    queryKey: ["nonce"],
    queryFn: ({ signal }) => get<{ nonce: string }>("/api/drive/nonce", signal),
    refetchInterval: NONCE_REFRESH_MS,
    gcTime: 0,
  });
  return useMutation({
    meta: { showsErrors: true },
    mutationFn: () => post<RunDocument>("/api/runs", { mission_id, link_loss, nonce: nonce.data?.nonce ?? "" }),
    onSuccess: () => {
      void client.invalidateQueries({ queryKey: ["runs"] });
      onStarted();
    },
    onError: () => nonce.refetch(),
  });
}

function Summary({ document, mission, preview }: Pick<Props, "document" | "mission" | "preview">) {
  const names = new Map(document.site.rows.map(({ id, name }) => [id, name]));
  const rows = mission.mission.visits.map(({ row_id }) => rowWords(row_id, names)).join(", ");
  if (!preview) return <Loader />;
  return (
    <dl className={css.summary}>
      <dt>Farm</dt>
      <dd>{document.name}</dd>
      <dt>Rows</dt>
      <dd>{rows || "none"}</dd>
      <dt>Way</dt>
      <dd>{preview.plan ? `${way(preview.length_m)}, about ${duration(preview.duration_s)}` : "no plan"}</dd>
    </dl>
  );
}

function LinkLoss({ value, onChange }: { value: LinkLossPolicy; onChange: (value: LinkLossPolicy) => void }) {
  return (
    <Radio.Group label="If no operator's page is heard of for 5 s" value={value} onChange={(v) => onChange(v as LinkLossPolicy)}>
      <div className={css.choices}>
        <Radio size="md" value="continue" label="Go on with the mission" />
        <Radio size="md" value="stop" label="Stop" />
      </div>
    </Radio.Group>
  );
}
