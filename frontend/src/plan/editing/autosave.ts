import { StationError } from "../../api/client";

export type SaveState =
  | { kind: "saved" }
  | { kind: "waiting" }
  | { kind: "saving" }
  | { kind: "conflict" }
  | { kind: "refused"; reasons: string[] }
  | { kind: "offline" };

const CONFLICT = 409;

interface Delays {
  quiet_ms: number;
  retry_ms: number;
}

/** Saves the newest state after a moment of quiet, one request at a time, each on top of the version before. */
export class Autosave<T> {
  state: SaveState = { kind: "saved" };
  private pending: T | null = null;
  private busy = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners = new Set<() => void>();

  constructor(
    private version: number,
    private readonly save: (version: number, value: T) => Promise<number>,
    private readonly delays: Delays = { quiet_ms: 700, retry_ms: 3000 },
  ) {}

  changed(value: T): void {
    this.pending = value;
    if (this.state.kind === "conflict") return;
    this.enter({ kind: "waiting" });
    this.later(this.delays.quiet_ms);
  }

  /** Saves now what has not been saved yet. */
  async flush(): Promise<void> {
    clearTimeout(this.timer);
    if (this.busy || this.pending === null || this.state.kind === "conflict") return;
    const value = this.pending;
    this.pending = null;
    this.busy = true;
    this.enter({ kind: "saving" });
    try {
      this.version = await this.save(this.version, value);
      this.enter({ kind: this.pending === null ? "saved" : "waiting" });
    } catch (error) {
      this.pending ??= value;
      this.fail(error);
    } finally {
      this.busy = false;
    }
    if (this.state.kind === "waiting") this.later(0);
  }

  /** After a conflict: what is drawn here takes the place of version `theirs`. */
  overwrite(theirs: number): Promise<void> {
    this.version = theirs;
    this.enter({ kind: "waiting" });
    return this.flush();
  }

  hasUnsaved(): boolean {
    return this.busy || this.pending !== null;
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  private fail(error: unknown): void {
    if (!(error instanceof StationError)) throw error;
    if (error.status === CONFLICT) return this.enter({ kind: "conflict" });
    if (error.status > 0) return this.enter({ kind: "refused", reasons: [error.message, ...error.reasons] });
    this.enter({ kind: "offline" });
    this.later(this.delays.retry_ms);
  }

  private later(ms: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.flush(), ms);
  }

  private enter(state: SaveState): void {
    this.state = state;
    this.listeners.forEach((listener) => listener());
  }
}
