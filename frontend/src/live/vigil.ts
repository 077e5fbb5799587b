/** A page that has not come to its turn for longer than this cannot be watched, and its stop button not be pressed. */
export const LONGEST_SILENCE_MS = 5000;
/** A page hidden for longer than this is watched by nobody: another tab is open, or the phone is in the pocket. */
export const LONGEST_HIDDEN_MS = 30_000;

/** Whether an operator can still be at the page: it keeps telling, and is not hidden for good. All times in ms. */
export class Vigil {
  private told = -Infinity;
  private hiddenSince: number | null = null;

  /** The page had its turn. */
  tell(hidden: boolean, now: number): void {
    this.told = now;
    this.hiddenSince = hidden ? (this.hiddenSince ?? now) : null;
  }

  isKept(now: number): boolean {
    return now - this.told <= LONGEST_SILENCE_MS && (this.hiddenSince === null || now - this.hiddenSince <= LONGEST_HIDDEN_MS);
  }
}
