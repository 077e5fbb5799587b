import { readMessage } from "./message";
import type { LiveStore } from "./store";

export type LinkState = "connecting" | "open" | "closed";

const HEARTBEAT_MS = 500;
const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 4000;

/** The page's one WebSocket: heartbeat at 2 Hz, reconnects with a growing delay, feeds the store. */
export class LiveSocket {
  private socket: WebSocket | null = null;
  private retry = 0;
  private beat = 0;
  private timers: { heartbeat?: number; reconnect?: number } = {};
  private readonly listeners = new Set<() => void>();
  state: LinkState = "closed";

  constructor(
    private readonly store: LiveStore,
    private readonly url: string,
    private readonly clock: () => number = () => performance.now(),
  ) {}

  open(): void {
    this.enter("connecting");
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.onOpen();
    socket.onmessage = (event) => this.onMessage(event.data as string | ArrayBuffer);
    socket.onclose = () => this.onClose(socket);
    this.socket = socket;
  }

  close(): void {
    window.clearTimeout(this.timers.reconnect);
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    this.endHeartbeat();
    this.enter("closed");
  }

  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private onOpen(): void {
    this.retry = 0;
    this.enter("open");
    this.timers.heartbeat = window.setInterval(() => this.sendHeartbeat(), HEARTBEAT_MS);
    this.sendHeartbeat();
  }

  private onMessage(payload: string | ArrayBuffer): void {
    const message = readMessage(payload);
    if (message) this.store.accept(message, this.clock());
  }

  private onClose(socket: WebSocket): void {
    this.endHeartbeat();
    if (this.socket !== socket) return;
    this.enter("closed");
    this.timers.reconnect = window.setTimeout(() => this.open(), retryDelay(this.retry++));
  }

  private sendHeartbeat(): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ heartbeat: this.beat++ }));
  }

  private endHeartbeat(): void {
    window.clearInterval(this.timers.heartbeat);
  }

  private enter(state: LinkState): void {
    this.state = state;
    this.listeners.forEach((listener) => listener());
  }
}

/** Delay before the n-th try in a row, doubling up to a bound, ms. */
export const retryDelay = (attempt: number) => Math.min(FIRST_RETRY_MS * 2 ** attempt, LONGEST_RETRY_MS);

export const liveUrl = (location: Location) =>
  `${location.protocol === "https:" ? "wss:" : "ws:"}//${location.host}/api/live`;
