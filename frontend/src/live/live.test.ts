import { describe, expect, test } from "vitest";

import { readMessage } from "./message";
import { LiveStore } from "./store";

function status(stamp_ns: number) {
  return { topic: "nav/status", data: { stamp_ns, v: 0.4 }, attachment: null };
}

function binary(header: object, picture: number[]): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const bytes = new Uint8Array(4 + text.length + picture.length);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  bytes.set(picture, 4 + text.length);
  return bytes.buffer;
}

describe("the live store", () => {
  test("keeps the newest message of a topic and tells who listens", () => {
    const store = new LiveStore();
    let calls = 0;
    const end = store.subscribe("nav/status", () => calls++);
    store.accept(status(1), 0);
    store.accept(status(2), 50);
    end();
    store.accept(status(3), 100);
    expect(store.newest("nav/status")?.data.stamp_ns).toBe(3);
    expect(calls).toBe(2);
  });

  test("calls data stale after one second, and before the first message", () => {
    const store = new LiveStore();
    expect(store.isFresh("nav/status", 0)).toBe(false);
    store.accept(status(1), 1000);
    expect(store.isFresh("nav/status", 2000)).toBe(true);
    expect(store.isFresh("nav/status", 2001)).toBe(false);
  });

  test("takes a message that is sent again with the same stamp for no sign of life", () => {
    const store = new LiveStore();
    store.accept(status(7), 0);
    store.accept(status(7), 900);
    expect(store.isFresh("nav/status", 1100)).toBe(false);
  });
});

describe("messages of the feed", () => {
  test("a picture travels with its own description", async () => {
    const message = readMessage(binary({ topic: "camera/view", data: { stamp_ns: 5 } }, [0xff, 0xd8, 0x01]));
    expect(message?.topic).toBe("camera/view");
    expect(new Uint8Array(await message!.attachment!.arrayBuffer())).toEqual(new Uint8Array([0xff, 0xd8, 0x01]));
  });

  test.each(["", "{", "null", "[]", '{"topic":3,"data":{}}', '{"topic":"nav/status","data":null}'])("%j is no message", (text) =>
    expect(readMessage(text)).toBeNull(),
  );

  test("a header longer than the message is no message", () => {
    const bytes = new Uint8Array(8);
    new DataView(bytes.buffer).setUint32(0, 5000, true);
    expect(readMessage(bytes.buffer)).toBeNull();
  });
});
