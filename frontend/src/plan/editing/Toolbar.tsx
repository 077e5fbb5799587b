import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconArrowLoopRight,
  IconBarrierBlock,
  IconBuildingWarehouse,
  IconPointer,
  IconPolygon,
  IconRoad,
  IconSeedling,
} from "@tabler/icons-react";
import type { Icon } from "@tabler/icons-react";

import css from "./editing.module.css";
import { TOOLS, type Tool } from "./tools";

const ICONS: Record<Tool, Icon> = {
  select: IconPointer,
  warehouse: IconBuildingWarehouse,
  lane: IconRoad,
  row: IconSeedling,
  keep_in: IconPolygon,
  keep_out: IconBarrierBlock,
  headland: IconArrowLoopRight,
};

interface Props {
  tool: Tool;
  onTool: (tool: Tool) => void;
  onUndo?: () => void;
  onRedo?: () => void;
}

/** Drawing tools; undo and redo are off where there is nothing to go back to. */
export function Toolbar({ tool, onTool, onUndo, onRedo }: Props) {
  return (
    <>
      <div className={css.toolbar} role="toolbar" aria-label="Drawing tools">
        {TOOLS.map(({ name, word }) => (
          <ToolButton key={name} icon={ICONS[name]} word={word} pressed={tool === name} onClick={() => onTool(name)} />
        ))}
      </div>
      <div className={css.history} role="group" aria-label="Undo and redo">
        <ToolButton icon={IconArrowBackUp} word="Undo" onClick={onUndo} />
        <ToolButton icon={IconArrowForwardUp} word="Redo" onClick={onRedo} />
      </div>
    </>
  );
}

function ToolButton({ icon: Glyph, word, pressed, onClick }: { icon: Icon; word: string; pressed?: boolean; onClick?: () => void }) {
  return (
    <button type="button" className={css.tool} aria-pressed={pressed} disabled={!onClick} onClick={onClick}>
      <Glyph size={24} aria-hidden />
      {word}
    </button>
  );
}
