import type { Arrived } from "./mailbox";
import { HEARTBEAT_MS, type LinkState } from "./socket";
import type { LiveStore } from "./store";
import type { FromWorker, ToWorker } from "./worker";

/** The page's end of the live feed. The worker that holds the socket ends with the page, and its heartbeat with it. */
export class LiveLink {
  private worker: Worker | null = null;
  private life = 0;
  private readonly listeners = new Set<() => void>();
  state: LinkState = "closed";

  constructor(
    private readonly store: LiveStore,
    private readonly url: string,
  ) {}

  open(): void {
    this.worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => (data.kind === "state" ? this.enter(data.state) : this.take(data.messages));
    this.tell({ kind: "open", url: this.url });
    this.life = window.setInterval(this.signLife, HEARTBEAT_MS);
    document.addEventListener("visibilitychange", this.signLife);
    this.signLife();
  }

  close(): void {
    window.clearInterval(this.life);
    document.removeEventListener("visibilitychange", this.signLife);
    this.worker?.terminate();
    this.worker = null;
    this.enter("closed");
  }

  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private readonly signLife = () => this.tell({ kind: "alive", hidden: document.hidden });

  private take(messages: Arrived[]): void {
    for (const message of messages) this.store.accept(message, message.arrived - performance.timeOrigin);
    this.tell({ kind: "read" });
  }

  private tell(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private enter(state: LinkState): void {
    this.state = state;
    this.listeners.forEach((listener) => listener());
  }
}
