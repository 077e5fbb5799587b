import type { LiveMessage, TopicName, Topics } from "./message";

export interface Entry<T> {
  data: T;
  attachment: Blob | null;
  /** Milliseconds of the page's own clock at arrival. */
  arrived: number;
}

type Listener = () => void;

/** Data older than this must not be acted on. */
export const STALE_AFTER_MS = 1000;

/** The newest message of every topic. A message that repeats the stamp before it is no sign of life. */
export class LiveStore {
  private readonly entries = new Map<string, Entry<unknown>>();
  private readonly listeners = new Map<string, Set<Listener>>();

  accept(message: LiveMessage, now: number): void {
    const before = this.entries.get(message.topic);
    if (before && stampOf(before.data) !== null && stampOf(before.data) === stampOf(message.data)) return;
    this.entries.set(message.topic, { data: message.data, attachment: message.attachment, arrived: now });
    this.listeners.get(message.topic)?.forEach((listener) => listener());
  }

  newest<T extends TopicName>(topic: T): Entry<Topics[T]> | null {
    return (this.entries.get(topic) as Entry<Topics[T]> | undefined) ?? null;
  }

  /** Milliseconds since the topic's newest message, infinite before the first. */
  age(topic: TopicName, now: number): number {
    const entry = this.entries.get(topic);
    return entry ? now - entry.arrived : Infinity;
  }

  isFresh(topic: TopicName, now: number): boolean {
    return this.age(topic, now) <= STALE_AFTER_MS;
  }

  /** Calls back on every message of the topic; returns how to end that. */
  subscribe(topic: TopicName, listener: Listener): () => void {
    const listeners = this.listeners.get(topic) ?? new Set();
    this.listeners.set(topic, listeners.add(listener));
    return () => listeners.delete(listener);
  }
}

function stampOf(data: unknown): number | null {
  const stamp = (data as { stamp_ns?: unknown }).stamp_ns;
  return typeof stamp === "number" ? stamp : null;
}
