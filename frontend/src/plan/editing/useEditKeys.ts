import { useEffect } from "react";

import type { ItemRef } from "../../map/siteFeatures";
import type { SiteEditing } from "../useSiteEditor";
import { removeItem } from "./edits";
import type { Tool } from "./tools";

interface Wanted {
  editing: SiteEditing;
  selected: ItemRef | null;
  onSelect: (ref: ItemRef | null) => void;
  onTool: (tool: Tool) => void;
}

const isTyping = (target: EventTarget | null) => target instanceof HTMLElement && target.closest("input, textarea, select, [role=dialog]") !== null;

/** Ctrl+Z, Ctrl+Y or Ctrl+Shift+Z, Delete, Escape. */
export function useEditKeys(wanted: Wanted): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (!isTyping(event.target) && act(event, wanted)) event.preventDefault();
    };
    window.addEventListener("keydown", onKey);
    return () => window.removeEventListener("keydown", onKey);
  });
}

function act(event: KeyboardEvent, { editing, selected, onSelect, onTool }: Wanted): boolean {
  const key = event.key.toLowerCase();
  const control = event.ctrlKey || event.metaKey;
  if (control && (key === "y" || (key === "z" && event.shiftKey))) editing.redo?.();
  else if (control && key === "z") editing.undo?.();
  else if (key === "escape") onTool("select");
  else if ((key === "delete" || key === "backspace") && selected) {
    editing.commit(removeItem(editing.site, selected));
    onSelect(null);
  } else return false;
  return true;
}
