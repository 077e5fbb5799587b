// Reads a run log as any other program would, and prints the number of messages of each topic as JSON.
import { open } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [modules, log] = process.argv.slice(2);
const { McapIndexedReader } = await import(pathToFileURL(`${modules}/@mcap/core/dist/esm/index.js`).href);
const file = await open(log);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, Number(length), Number(offset));
    return bytes;
  },
};
const reader = await McapIndexedReader.Initialize({ readable });
const counts = {};
const decoder = new TextDecoder();
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const topic = reader.channelsById.get(message.channelId).topic;
  JSON.parse(decoder.decode(message.data));
  counts[topic] = (counts[topic] ?? 0) + 1;
}
for (const schema of reader.schemasById.values()) JSON.parse(decoder.decode(schema.data));
await file.close();
process.stdout.write(JSON.stringify({ counts, topics: [...reader.channelsById.values()].map((c) => c.topic) }));
