import { type KeyboardEvent, type ReactNode, useEffect, useRef, useState } from "react";

import css from "./ui.module.css";

const HOLD_MS = 1500;

const isPress = (event: KeyboardEvent) => event.key === " " || event.key === "Enter";

/** Acts only after it has been held down for a while: a stray tap, a click or a repeating key does nothing. */
export function HoldButton({ children, onHeld, disabled }: { children: ReactNode; onHeld: () => void; disabled?: boolean }) {
  const [holding, setHolding] = useState(false);
  const timer = useRef<number>(undefined);
  const release = () => {
    window.clearTimeout(timer.current);
    setHolding(false);
  };
  const press = () => {
    if (disabled) return;
    release();
    setHolding(true);
    timer.current = window.setTimeout(() => {
      setHolding(false);
      onHeld();
    }, HOLD_MS);
  };
  useEffect(() => () => window.clearTimeout(timer.current), []);
  useEffect(() => {
    if (disabled) release();
  }, [disabled]);
  return (
    <button
      type="button"
      className={`${css.hold} ${holding ? css.holding : ""}`}
      style={{ "--hold-time": `${HOLD_MS}ms` } as React.CSSProperties}
      disabled={disabled}
      onPointerDown={(event) => event.button === 0 && press()}
      onPointerUp={release}
      onPointerLeave={release}
      onPointerCancel={release}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => isPress(event) && !event.repeat && press()}
      onKeyUp={release}
      onBlur={release}
    >
      <span className={css.holdFill} />
      <span className={css.holdText}>{children}</span>
    </button>
  );
}
