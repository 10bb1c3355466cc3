// Reads an MCAP file by its index with the format's own library, checking every CRC, and prints what
// is in it as JSON.  usage: node read_mcap.mjs FILE
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";
import { open } from "node:fs/promises";

const file = await open(process.argv[2]);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
const decompressHandlers = { zstd: (bytes) => decompress(bytes) };
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });

const schemas = {};
const topics = {};
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId);
  schemas[schema.name] = JSON.parse(new TextDecoder().decode(schema.data));
  topics[channel.topic] = { schema: schema.name, encoding: channel.messageEncoding, count: 0 };
}
let last = 0n;
for await (const message of reader.readMessages()) {
  const topic = topics[reader.channelsById.get(message.channelId).topic];
  const value = JSON.parse(new TextDecoder().decode(message.data));
  const wanted = Object.keys(schemas[topic.schema].properties);
  if (JSON.stringify(Object.keys(value)) !== JSON.stringify(wanted)) {
    throw new Error(`${topic.schema}: fields differ from its schema`);
  }
  if (message.logTime < last) throw new Error("times go back");
  last = message.logTime;
  topic.count += 1;
  topic.first ??= value;
}
const total = Number(reader.statistics.messageCount);
const seekTo = reader.statistics.messageEndTime;
let atEnd = 0;
for await (const _ of reader.readMessages({ startTime: seekTo })) atEnd += 1;
console.log(JSON.stringify({ topics, total, atEnd, chunks: reader.chunkIndexes.length }));
await file.close();
