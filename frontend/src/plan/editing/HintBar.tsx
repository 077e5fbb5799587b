import { Button } from "@mantine/core";

import css from "./editing.module.css";
import { TOOLS, type Tool, isZone } from "./tools";

/** What to tap next, and the buttons that a finger needs where a mouse would double-click. */
export function HintBar({ tool, onDone, onBack, onCancel }: { tool: Tool; onDone: () => void; onBack: () => void; onCancel: () => void }) {
  const hint = TOOLS.find(({ name }) => name === tool)?.hint;
  if (!hint) return null;
  return (
    <div className={css.hint} role="status">
      <span>{hint}</span>
      <Button variant="default" onClick={onBack}>
        Undo point
      </Button>
      {(tool === "lane" || isZone(tool)) && <Button onClick={onDone}>Done</Button>}
      <Button variant="default" onClick={onCancel}>
        Cancel
      </Button>
    </div>
  );
}
