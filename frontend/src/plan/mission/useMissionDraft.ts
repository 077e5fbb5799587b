import { useMutation, useQuery, useQueryClient } from "@tanstack/react-query";
import { useState } from "react";

import { useChosenMission } from "../../api/chosenMission";
import { post, put } from "../../api/client";
import { previewQuery } from "../../api/queries";
import type { Mission, MissionDocument, Point, RowExit, SiteDocument } from "../../api/types";
import { addVisit } from "./missionEdits";

interface Draft {
  /** Null until it was saved for the first time. */
  stored: MissionDocument | null;
  mission: Mission;
}

/** The mission being made: from one press on a row, or an opened one; previewed by the code that drives. */
export function useMissionDraft(document: SiteDocument) {
  const client = useQueryClient();
  const [draft, setDraft] = useState<Draft | null>(null);
  const [exit, setExit] = useState<RowExit>("reverse");
  const [place, setPlace] = useState<Point | null>(null);
  const [, choose] = useChosenMission(document.id);
  const preview = useQuery(previewQuery(document.id, draft?.mission ?? null, document.version));
  const open = (stored: MissionDocument) => {
    setDraft({ stored, mission: stored.mission });
    choose(stored.id);
  };
  const edit = (mission: Mission) => setDraft((before) => before && { ...before, mission });
  const forRow = useMutation({
    mutationFn: (to: { row_id: string; stop_at?: string }) => post<Mission>(`/api/sites/${document.id}/missions/for-row`, { exit, ...to }),
    onSuccess: (mission) => setDraft({ stored: null, mission }),
  });
  const save = useMutation({
    mutationFn: ({ stored, mission }: Draft) =>
      stored
        ? put<MissionDocument>(`/api/missions/${stored.id}`, { version: stored.version, mission })
        : post<MissionDocument>(`/api/sites/${document.id}/missions`, { mission }),
    onSuccess: (stored) => {
      open(stored);
      void client.invalidateQueries({ queryKey: ["missions"] });
    },
  });
  return {
    draft,
    exit,
    setExit,
    /** A spot to be shown on the map. */
    place,
    setPlace,
    preview: draft ? preview : null,
    edit,
    save,
    making: forRow.isPending,
    open,
    close: () => setDraft(null),
    pressRow: (row_id: string) => (draft ? edit(addVisit(draft.mission, row_id)) : forRow.mutate({ row_id })),
    /** A new mission to a trunk beside a row, and back out in reverse. */
    pressTrunk: (row_id: string, stop_at: string) => forRow.mutate({ row_id, stop_at }),
    unsaved: draft !== null && draft.mission !== draft.stored?.mission,
  };
}

export type MissionDraft = ReturnType<typeof useMissionDraft>;
