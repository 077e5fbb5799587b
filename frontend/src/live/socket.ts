import { type LiveMessage, readMessage } from "./message";

export type LinkState = "connecting" | "open" | "closed";

export const HEARTBEAT_MS = 500;
const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 4000;

export interface SocketEvents {
  onState: (state: LinkState) => void;
  onMessage: (message: LiveMessage) => void;
  /** Whether an operator is at the page: without one there is no heartbeat. */
  isWatched: () => boolean;
}

/** The page's one WebSocket: heartbeat at 2 Hz, reconnects with a growing delay. */
export class LiveSocket {
  private socket: WebSocket | null = null;
  private retry = 0;
  private beat = 0;
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly url: string,
    private readonly events: SocketEvents,
  ) {}

  open(): void {
    this.events.onState("connecting");
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.onOpen();
    socket.onmessage = (event) => this.onMessage(event.data as string | ArrayBuffer);
    socket.onclose = () => this.onClose();
    this.socket = socket;
  }

  private onOpen(): void {
    this.retry = 0;
    this.events.onState("open");
    this.timer = setInterval(() => this.sendHeartbeat(), HEARTBEAT_MS);
    this.sendHeartbeat();
  }

  private onMessage(payload: string | ArrayBuffer): void {
    const message = readMessage(payload);
    if (message) this.events.onMessage(message);
  }

  private onClose(): void {
    clearInterval(this.timer);
    this.events.onState("closed");
    setTimeout(() => this.open(), retryDelay(this.retry++));
  }

  private sendHeartbeat(): void {
    if (this.events.isWatched()) this.socket?.send(JSON.stringify({ heartbeat: this.beat++ }));
  }
}

/** Delay before the n-th try in a row, doubling up to a bound, ms. */
export const retryDelay = (attempt: number) => Math.min(FIRST_RETRY_MS * 2 ** attempt, LONGEST_RETRY_MS);

export const liveUrl = (location: Location) => `${location.protocol === "https:" ? "wss:" : "ws:"}//${location.host}/api/live`;
