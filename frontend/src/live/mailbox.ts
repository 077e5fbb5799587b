import type { LiveMessage } from "./message";

export interface Arrived extends LiveMessage {
  /** Milliseconds since 1970 at arrival: the only clock that a page and its worker share. */
  arrived: number;
}

/** Newest wins: what a busy page has not read yet is replaced, never queued. One delivery at a time. */
export class Mailbox {
  private readonly waiting = new Map<string, Arrived>();
  private reading = false;

  constructor(private readonly deliver: (messages: Arrived[]) => void) {}

  put(message: Arrived): void {
    this.waiting.set(message.topic, message);
    this.hand();
  }

  /** The page has read what was delivered. */
  read(): void {
    this.reading = false;
    this.hand();
  }

  private hand(): void {
    if (this.reading || this.waiting.size === 0) return;
    this.reading = true;
    const messages = [...this.waiting.values()];
    this.waiting.clear();
    this.deliver(messages);
  }
}
