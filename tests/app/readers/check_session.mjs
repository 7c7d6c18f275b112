// Reads sessions with @mcap/core and @foxglove/rosmsg2-serialization, which share nothing with Helical's reader.
//   node check_session.mjs MODULES SESSION          whole: every rule of the format that a reader can check
//   node check_session.mjs MODULES SESSION --cut    cut off: what can be read of it
//   ... | with --dump FILE: every message equals what Helical's own reader found in it (tests/session/dump_session.cpp)
// Prints one JSON object; a broken rule is an exception.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { createReadStream } from "node:fs";

const [modules, file, ...flags] = process.argv.slice(2);
const require = createRequire(`${modules}/package.json`);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { parse } = require("@foxglove/rosmsg");
const { decompress } = require("fzstd");
const { crc32 } = require("@foxglove/crc");

const bytes = readFileSync(file);
const decompressHandlers = { zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))) };
const text = new TextDecoder();

/// Everything in the file's order; CRCs of chunks, attachments and data are checked on the way.
function readStream() {
  const reader = new McapStreamReader({ includeChunks: true, decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  const found = { schemas: new Map(), channels: new Map(), messages: [], attachments: [], chunks: [], indexes: [] };
  const sequences = new Map();
  for (let record; (record = reader.nextRecord()) !== undefined; ) {
    if (record.type === "Schema") found.schemas.set(record.id, record);
    if (record.type === "Channel") found.channels.set(record.id, record);
    if (record.type === "Attachment") found.attachments.push(record);
    if (record.type === "MessageIndex") found.indexes.push({ ...record, chunk: found.chunks.length - 1 });
    if (record.type === "Statistics") found.statistics = record;
    if (record.type === "Chunk") found.chunks.push({ start: record.messageStartTime, end: record.messageEndTime, count: 0 });
    if (record.type !== "Message") continue;
    const chunk = found.chunks.at(-1);
    ++chunk.count;
    assert(record.logTime >= chunk.start && record.logTime <= chunk.end, "a message outside its chunk's times");
    assert.equal(record.sequence, sequences.get(record.channelId) ?? 0, "a gap in a channel's sequence");
    sequences.set(record.channelId, record.sequence + 1);
    assert(found.channels.has(record.channelId), "a message of no channel");
    found.messages.push({ ...record, data: record.data.slice() });
  }
  return { ...found, done: reader.done() };
}

async function checkIndex(stream) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  assert.equal(reader.header.profile, "ros2");
  let count = 0, last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    assert(message.logTime >= last, "the index is out of order");
    last = message.logTime;
    ++count;
  }
  assert.equal(count, stream.messages.length);
  assert.equal(reader.chunkIndexes.length, stream.chunks.length);
  assert.equal(reader.attachmentIndexes.length, stream.attachments.length);
  const listed = stream.indexes.reduce((sum, index) => sum + index.records.length, 0);
  assert.equal(listed, stream.messages.length);
  const counted = reader.statistics;
  assert.equal(counted.messageCount, BigInt(count));
  assert.equal(counted.chunkCount, stream.chunks.length);
  assert.equal(counted.channelCount, stream.channels.size);
  assert.equal(counted.schemaCount, stream.schemas.size);
  assert.equal(counted.attachmentCount, stream.attachments.length);
  const times = stream.messages.map((message) => message.logTime);
  const least = (a, b) => (a < b ? a : b), most = (a, b) => (a > b ? a : b);
  assert.equal(counted.messageStartTime, times.reduce(least));
  assert.equal(counted.messageEndTime, times.reduce(most));
  const perChannel = new Map();
  for (const message of stream.messages)
    perChannel.set(message.channelId, (perChannel.get(message.channelId) ?? 0n) + 1n);
  assert.deepEqual(new Map(counted.channelMessageCounts), perChannel);
}

function decodersOf(stream) {
  const decoders = new Map();
  for (const [id, channel] of stream.channels) {
    const schema = stream.schemas.get(channel.schemaId);
    assert.equal(schema.encoding, "ros2msg");
    assert.equal(channel.messageEncoding, "cdr");
    const definitions = parse(text.decode(schema.data), { ros2: true });
    decoders.set(id, { definitions, reader: new MessageReader(definitions), image: /Image$/.test(schema.name) });
  }
  return decoders;
}

/// A decoded message as Helical's tables have it: one row, or one for each element of the list in it.
function rowsOf(definitions, message) {
  const types = new Map(definitions.map((definition) => [definition.name, definition.definitions]));
  let elements = null, place = 0;
  const walk = (fields, value, cells) => {
    for (const field of fields) {
      if (field.isConstant) continue;
      const inner = value[field.name];
      if (field.isArray && field.isComplex) {
        place = cells.length;
        elements = [...inner].map((element) => walk(types.get(field.type), element, []));
      } else if (field.isArray && field.arrayLength === undefined) {
        cells.push([...inner]);
      } else if (field.isArray) {
        cells.push(...inner);
      } else if (field.isComplex) {
        walk(types.get(field.type), inner, cells);
      } else {
        cells.push(inner);
      }
    }
    return cells;
  };
  const cells = walk(definitions[0].definitions, message, []);
  if (elements === null) return { rows: [cells], empty: false };
  if (elements.length === 0) return { rows: [cells], empty: true };
  return { rows: elements.map((element) => [...cells.slice(0, place), ...element, ...cells.slice(place)]), empty: false };
}

function same(value, cell) {
  if (typeof value === "string") return value === cell;
  if (typeof value === "boolean") return cell === (value ? "1" : "0");
  if (typeof value === "bigint") return value === BigInt(cell);
  if (Array.isArray(value)) {
    const parts = cell === "" ? [] : cell.split(" ");
    return value.length === parts.length && value.every((element, i) => same(element, parts[i]));
  }
  if (typeof value === "object") return cell === `${value.sec}.${String(value.nanosec).padStart(9, "0")}`;
  return Object.is(value, Number(cell)) || Math.fround(Number(cell)) === value;
}

/// Line by line what Helical's reader made of the same file.
async function compare(stream, decoders, dump) {
  let at = 0;
  for await (const line of createInterface({ input: createReadStream(dump) })) {
    const own = JSON.parse(line), message = stream.messages[at++];
    assert.equal(stream.channels.get(message.channelId).topic, own.topic);
    assert.equal(String(message.logTime), own.log_time);
    assert.equal(String(message.publishTime), own.publish_time);
    assert.equal(crc32(message.data), own.crc);
    const { definitions, reader, image } = decoders.get(message.channelId);
    const decoded = reader.readMessage(message.data);
    if (image) {
      assert(decoded.data.length > 0);
      if (decoded.step !== undefined) assert.equal(decoded.data.length, decoded.step * decoded.height);
      continue;
    }
    const { rows, empty } = rowsOf(definitions, decoded);
    const cells = empty ? own.rows.map((row) => row.filter((cell) => cell !== "")) : own.rows;
    const values = empty ? rows.map((row) => row.filter((value) => value !== "")) : rows;
    assert.equal(cells.length, values.length, own.topic);
    values.forEach((row, r) => {
      assert.equal(cells[r].length, row.length, own.topic);
      row.forEach((value, c) => assert(same(value, cells[r][c]), `${own.topic}: ${value} is not ${cells[r][c]}`));
    });
  }
  assert.equal(at, stream.messages.length);
}

const stream = readStream();
const cut = flags.includes("--cut");
if (!cut) {
  assert(stream.done, "the file does not end as it should");
  await checkIndex(stream);
}
const decoders = decodersOf(stream);
for (const message of stream.messages) decoders.get(message.channelId).reader.readMessage(message.data);
if (flags.includes("--dump")) await compare(stream, decoders, flags[flags.indexOf("--dump") + 1]);
const last = stream.messages.reduce((most, message) => (message.logTime > most ? message.logTime : most), 0n);
console.log(JSON.stringify({ messages: stream.messages.length, last_s: Number(last) * 1e-9,
                             attachments: stream.attachments.map((attachment) => attachment.name) }));
