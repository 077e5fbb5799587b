import { Button } from "@mantine/core";
import { IconRulerMeasure } from "@tabler/icons-react";
import { useMutation, useQueryClient } from "@tanstack/react-query";

import { put } from "../api/client";
import { versionsQuery } from "../api/queries";
import type { CameraName, VersionDocument } from "../api/types";
import { useTopic } from "../live/hooks";
import { Badge } from "../ui/Badge";
import { EmptyState } from "../ui/EmptyState";
import { moment } from "../ui/format";
import { notifyDone, notifyError } from "../ui/notify";
import { pixels } from "./foundWords";
import css from "./setup.module.css";
import { inUseWords, mountWords } from "./versionWords";

/** All calibrations that were kept, which is in use, and a button to use another one. */
export function VersionList({ versions, disabled }: { versions: VersionDocument[]; disabled: boolean }) {
  const client = useQueryClient();
  const use = useMutation({
    mutationFn: (choice: { camera: CameraName; id: string | null; rehearsal: boolean }) => put<VersionDocument[]>("/api/calibration/versions", choice),
    onSuccess: (stored, choice) => {
      client.setQueryData(versionsQuery.queryKey, stored);
      notifyDone(chosenWords(choice));
    },
    onError: notifyError,
  });
  if (versions.length === 0) {
    return (
      <EmptyState icon={IconRulerMeasure} title="No calibration yet">
        The cameras go by the numbers in the robot's settings. What you find with a board stands here, and one press puts it in use.
      </EmptyState>
    );
  }
  return (
    <section className={css.versions} aria-label="Calibrations">
      <h2>Calibrations</h2>
      {versions.map((stored) => (
        <VersionLine key={`${stored.camera}${stored.rehearsal}${stored.id}`} stored={stored} disabled={disabled || use.isPending} onUse={(id) => use.mutate({ camera: stored.camera, id, rehearsal: stored.rehearsal })} />
      ))}
    </section>
  );
}

function chosenWords({ id, rehearsal }: { id: string | null; rehearsal: boolean }): string {
  if (rehearsal) return id ? "Rehearsals go by it." : "Put aside.";
  return `The robot sees by ${id ? "it" : "its settings"} in a few seconds.`;
}

function VersionLine({ stored, disabled, onUse }: { stored: VersionDocument; disabled: boolean; onUse: (id: string | null) => void }) {
  const { version, camera, rehearsal } = stored;
  const told = useTopic("calibration/in_use");
  const words = inUseWords(stored, told);
  return (
    <article className={css.version}>
      <div>
        <b>
          {camera === "front" ? "Front" : "Rear"} camera{version ? ` · ${version.camera}` : ""}
        </b>
        <span>{version ? `${moment(version.made_utc)} · ${version.made_by} · robot ${version.robot}` : stored.id}</span>
        {version && (
          <span>
            {version.pictures} pictures, {pixels(version.left_out_px)} on pictures left out · {version.intrinsics.width_px} × {version.intrinsics.height_px} px
          </span>
        )}
        {version && <span>{mountWords(version)}</span>}
        {stored.problem && <span className={css.problem}>{stored.problem}</span>}
      </div>
      <div className={css.badges}>
        {rehearsal && <Badge tone="warn">Rehearsal</Badge>}
        {words && <Badge tone={words.tone}>{words.text}</Badge>}
      </div>
      {stored.in_use ? (
        <Button variant="default" disabled={disabled} onClick={() => onUse(null)}>
          {rehearsal ? "Put aside" : "Use the settings"}
        </Button>
      ) : (
        <Button variant="default" disabled={disabled || !version} onClick={() => onUse(stored.id)}>
          Put in use
        </Button>
      )}
    </article>
  );
}
