import { useQueryClient } from "@tanstack/react-query";
import { useEffect, useMemo, useReducer, useRef, useSyncExternalStore } from "react";

import { put } from "../api/client";
import { siteQuery } from "../api/queries";
import type { SiteDocument, SiteMap } from "../api/types";
import { Autosave } from "./editing/autosave";
import { type History, begin, commit, redo, undo } from "./editing/history";

type Step = { kind: "commit"; site: SiteMap } | { kind: "undo" } | { kind: "redo" };

function reduce(history: History<SiteMap>, step: Step): History<SiteMap> {
  if (step.kind === "commit") return commit(history, step.site);
  return step.kind === "undo" ? undo(history) : redo(history);
}

/** The site being drawn, with undo, redo and autosave. `document` counts at the beginning only. */
export function useSiteEditor(document: SiteDocument) {
  const client = useQueryClient();
  const [history, dispatch] = useReducer(reduce, document.site, begin);
  const autosave = useMemo(
    () =>
      new Autosave<SiteMap>(document.version, async (version, site) => {
        const saved = await put<SiteDocument>(`/api/sites/${document.id}`, { version, site });
        client.setQueryData(siteQuery(document.id).queryKey, saved);
        void client.invalidateQueries({ queryKey: ["sites"] });
        return saved.version;
      }),
    // One autosave per editor: it keeps count of the version by itself.
    [],
  );
  const saving = useSyncExternalStore(autosave.subscribe, () => autosave.state);
  const { present } = history;
  const before = useRef(present);
  useEffect(() => {
    if (before.current !== present) autosave.changed(present);
    before.current = present;
  }, [autosave, present]);
  useEffect(() => keepFromLeaving(autosave), [autosave]);
  return {
    site: present,
    saving,
    autosave,
    commit: (site: SiteMap) => dispatch({ kind: "commit", site }),
    undo: history.past.length > 0 ? () => dispatch({ kind: "undo" }) : undefined,
    redo: history.future.length > 0 ? () => dispatch({ kind: "redo" }) : undefined,
  };
}

export type SiteEditing = ReturnType<typeof useSiteEditor>;

/** Leaving the page saves; closing the browser with unsaved changes asks first. */
function keepFromLeaving(autosave: Autosave<SiteMap>): () => void {
  const ask = (event: BeforeUnloadEvent) => autosave.hasUnsaved() && event.preventDefault();
  window.addEventListener("beforeunload", ask);
  return () => {
    window.removeEventListener("beforeunload", ask);
    void autosave.flush();
  };
}
