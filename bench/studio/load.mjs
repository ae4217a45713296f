// SPDX-License-Identifier: GPL-3.0-or-later
// What the studio bears: load.mjs FURROW GARMENT [BODY]. No browser: plain sockets that speak WebSocket.
//  - memory: resident after 500 strokes, each undone, over that after the first;
//  - streaming: the server thread's share of a core while a page sees the cloth move for ten seconds;
//  - a page that stalls: how far the cloth moves in ten seconds with one that reads nothing, over that without.
// Linux alone: it reads /proc.
import { randomBytes } from "node:crypto";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { start } from "./start.mjs";

const [furrow, garment, body] = process.argv.slice(2);
const scratch = mkdtempSync(join(tmpdir(), "furrow-load-"));
const { program, url: address } = await start(furrow, garment, body, scratch);
const url = new URL(address);

/** A page as the program sees it. */
class Page {
  constructor() {
    this.socket = connect(Number(url.port), "127.0.0.1");
    this.waiting = new Map();
    this.rest = Buffer.alloc(0);
    this.frames = 0;
    this.bytes = 0;
    this.time = 0;
    this.next = 1;
    this.opened = new Promise((done) => (this.open = done));
    this.socket.write(`GET /ws${url.search} HTTP/1.1\r\nHost: ${url.host}\r\nOrigin: http://${url.host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n`
      + `Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ${randomBytes(16).toString("base64")}\r\n\r\n`);
    this.socket.on("data", (data) => {
      this.bytes += data.length;
      this.rest = Buffer.concat([this.rest, data]);
      if (!this.isOpen) {
        const end = this.rest.indexOf("\r\n\r\n");
        if (end < 0) return;
        this.rest = this.rest.subarray(end + 4);
        this.isOpen = true;
        this.open();
      }
      while (this.take());
    });
  }
  /** One frame of the protocol, if it is there. */
  take() {
    const b = this.rest;
    if (b.length < 2) return false;
    let length = b[1] & 127, at = 2;
    if (length === 126) [length, at] = [b.length < 4 ? Infinity : b.readUInt16BE(2), 4];
    else if (length === 127) [length, at] = [b.length < 10 ? Infinity : Number(b.readBigUInt64BE(2)), 10];
    if (b.length < at + length) return false;
    const body = b.subarray(at, at + length), kind = b[0] & 15;
    this.rest = b.subarray(at + length);
    if (kind === 1) {
      const message = JSON.parse(body.toString());
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    } else if (kind === 2 && body.readUInt32LE(4) === 3) {
      ++this.frames;
      this.time = body.readUInt32LE(12) / 1000;
    }
    return true;
  }
  ask(what, body = {}) {
    const id = this.next++, text = Buffer.from(JSON.stringify({ id, do: what, ...body })), mask = randomBytes(4);
    const head = text.length < 126 ? Buffer.from([0x81, 0x80 | text.length]) : Buffer.from([0x81, 0xfe, text.length >> 8, text.length & 255]);
    this.socket.write(Buffer.concat([head, mask, text.map((c, i) => c ^ mask[i % 4])]));
    return new Promise((done) => this.waiting.set(id, done));
  }
}

const resident = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${program.pid}/status`, "utf8"))[1]) / 1024;
/** Processor seconds of the server's thread. */
const served = () => {
  for (const task of readdirSync(`/proc/${program.pid}/task`)) {
    const stat = readFileSync(`/proc/${program.pid}/task/${task}/stat`, "utf8");
    if (!stat.includes("(studio-server)")) continue;
    const words = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
    return (Number(words[11]) + Number(words[12])) / 100;
  }
  throw new Error("there is no thread of the server");
};
const wait = (seconds) => new Promise((done) => setTimeout(done, 1000 * seconds));
const must = async (answer) => {
  const message = await answer;
  if (message.refused) throw new Error(message.refused);
  return message.done;
};

try {
  const page = new Page();
  await page.opened;
  const points = [];
  const { min, max } = box(readFileSync(resolve(garment), "utf8"));
  for (let i = 0; i <= 10; ++i) points.push([(min[0] + max[0]) / 2 + 0.02, min[1] + (max[1] - min[1]) * (0.35 + 0.03 * i), max[2]]);
  await must(page.ask("draw", { height: 0.01, points }));
  await must(page.ask("undo"));
  const before = resident();
  for (let i = 0; i < 500; ++i) {
    await must(page.ask("draw", { height: 0.005 + 0.00002 * i, points }));
    await must(page.ask("undo"));
  }
  console.log(`memory: ${before.toFixed(0)} MB after a stroke and its undo, ${resident().toFixed(0)} MB after 500 more: ${(resident() / before).toFixed(2)} times`);

  const play = async (seconds) => {
    const played = page.ask("play");
    const first = page.frames;
    while (page.frames === first) await wait(0.02);
    const [frames, time, cpu, bytes] = [page.frames, page.time, served(), page.bytes];
    await wait(seconds);
    const share = (served() - cpu) / seconds, way = page.time - time, shown = (page.frames - frames) / seconds, rate = (page.bytes - bytes) / seconds / 1e6;
    await page.ask("pause");
    await must(played);
    await must(page.ask("undo"));
    return { share, way, shown, rate };
  };
  const alone = await play(10);
  console.log(`streaming: ${alone.shown.toFixed(1)} meshes/s, ${alone.rate.toFixed(1)} MB/s, the server's thread ${(100 * alone.share).toFixed(1)} % of a core`);
  const stalled = new Page();
  await stalled.opened;
  stalled.socket.pause();
  const beside = await play(10);
  console.log(`a page that reads nothing: the cloth moves ${beside.way.toFixed(2)} s in ten, alone ${alone.way.toFixed(2)}: ${(beside.way / alone.way).toFixed(2)} times`);
  stalled.socket.destroy();
  page.socket.destroy();
} finally {
  program.removeAllListeners("exit");
  program.kill("SIGINT");
  rmSync(scratch, { recursive: true, force: true });
}

/** Of an OBJ's vertices. */
function box(text) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (const [, ...xyz] of text.matchAll(/^v (\S+) (\S+) (\S+)/gm))
    for (let k = 0; k < 3; ++k) {
      min[k] = Math.min(min[k], Number(xyz[k]));
      max[k] = Math.max(max[k], Number(xyz[k]));
    }
  return { min, max };
}
