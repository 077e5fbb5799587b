import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { type Arrived, Mailbox } from "./mailbox";
import { LiveSocket, retryDelay } from "./socket";
import { LONGEST_HIDDEN_MS, LONGEST_SILENCE_MS, Vigil } from "./vigil";

const arrived = (topic: string, arrived: number): Arrived => ({ topic, data: {}, attachment: null, arrived });

describe("a page counts as watched", () => {
  test("while it keeps coming to its turn, and not long after", () => {
    const vigil = new Vigil();
    expect(vigil.isKept(0)).toBe(false);
    vigil.tell(false, 0);
    expect(vigil.isKept(LONGEST_SILENCE_MS)).toBe(true);
    expect(vigil.isKept(LONGEST_SILENCE_MS + 1)).toBe(false);
  });

  test("until it has been hidden for too long, and again when it is shown", () => {
    const vigil = new Vigil();
    for (let now = 0; now <= LONGEST_HIDDEN_MS + 1000; now += 1000) vigil.tell(true, now);
    expect(vigil.isKept(LONGEST_HIDDEN_MS)).toBe(true);
    expect(vigil.isKept(LONGEST_HIDDEN_MS + 1000)).toBe(false);
    vigil.tell(false, LONGEST_HIDDEN_MS + 1000);
    expect(vigil.isKept(LONGEST_HIDDEN_MS + 1000)).toBe(true);
  });
});

test("a busy page finds the newest of each topic, and nothing older", () => {
  const deliveries: number[][] = [];
  const mailbox = new Mailbox((messages) => deliveries.push(messages.map(({ arrived }) => arrived)));
  mailbox.put(arrived("nav/status", 1));
  for (let now = 2; now < 100; now++) mailbox.put(arrived("nav/status", now));
  mailbox.put(arrived("camera/view", 100));
  mailbox.read();
  mailbox.read();
  expect(deliveries).toEqual([[1], [99, 100]]);
});

describe("the socket", () => {
  const sockets: FakeSocket[] = [];

  class FakeSocket {
    sent: string[] = [];
    onopen = () => {};
    onclose = () => {};
    constructor() {
      sockets.push(this);
    }
    send = (text: string) => this.sent.push(text);
  }

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal("WebSocket", FakeSocket);
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
    sockets.length = 0;
  });

  const opened = (isWatched: () => boolean) => new LiveSocket("ws://robot", { onState: () => {}, onMessage: () => {}, isWatched }).open();

  test("beats twice a second while the page is watched, and falls silent when it is not", () => {
    let watched = true;
    opened(() => watched);
    sockets[0]!.onopen();
    vi.advanceTimersByTime(1000);
    expect(sockets[0]!.sent).toEqual(['{"heartbeat":0}', '{"heartbeat":1}', '{"heartbeat":2}']);
    watched = false;
    vi.advanceTimersByTime(5000);
    expect(sockets[0]!.sent.length).toBe(3);
  });

  test("is opened again when it was lost, and the lost one beats no more", () => {
    opened(() => true);
    sockets[0]!.onopen();
    sockets[0]!.onclose();
    vi.advanceTimersByTime(5000);
    expect([sockets.length, sockets[0]!.sent.length]).toEqual([2, 1]);
  });

  test("waits longer after each lost connection, but never more than four seconds", () => {
    expect([0, 1, 2, 10].map(retryDelay)).toEqual([250, 500, 1000, 4000]);
  });
});
