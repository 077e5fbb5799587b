import { IconAlertTriangle, IconInfoCircle } from "@tabler/icons-react";

import css from "./ui.module.css";

/** Every reason at once. With `onPick`, a reason can be pressed to be shown where it is. */
export function Reasons({ reasons, tone = "bad", onPick }: {
  reasons: readonly string[];
  tone?: "bad" | "warn" | "quiet";
  onPick?: (reason: string) => void;
}) {
  if (reasons.length === 0) return null;
  const Glyph = tone === "quiet" ? IconInfoCircle : IconAlertTriangle;
  return (
    <div className={`${css.reasons} ${css[tone]}`} role={tone === "bad" ? "alert" : "status"}>
      <ul>
        {reasons.map((reason) => (
          <li key={reason}>
            <Glyph size={20} aria-hidden />
            {onPick ? (
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
