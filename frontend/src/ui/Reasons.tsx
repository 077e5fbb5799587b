import { IconAlertTriangle, IconInfoCircle } from "@tabler/icons-react";

import css from "./ui.module.css";

/** Every reason at once. A reason that can be picked is shown where it is when pressed. */
export function Reasons({ reasons, tone = "bad", onPick, canPick }: {
  reasons: readonly string[];
  tone?: "bad" | "warn" | "quiet";
  onPick?: (reason: string) => void;
  canPick?: (reason: string) => boolean;
}) {
  if (reasons.length === 0) return null;
  const Glyph = tone === "quiet" ? IconInfoCircle : IconAlertTriangle;
  return (
    <div className={`${css.reasons} ${css[tone]}`} role={tone === "bad" ? "alert" : "status"}>
      <ul>
        {reasons.map((reason) => (
          <li key={reason}>
            <Glyph size={20} aria-hidden />
            {onPick && canPick?.(reason) ? (
              <button type="button" className={css.reasonButton} onClick={() => onPick(reason)}>
                {reason}
              </button>
            ) : (
              <span>{reason}</span>
            )}
          </li>
        ))}
      </ul>
    </div>
  );
}
