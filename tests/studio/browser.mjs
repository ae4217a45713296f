// SPDX-License-Identifier: GPL-3.0-or-later
// A real browser for tests of the studio, which are called with FURROW MESHES PAGE OUT: the program, our meshes, the folder
// whose node_modules has playwright-core, and where pictures of the steps are kept. Ends with 77, which ctest counts as
// skipped, where there is no Chromium.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { inflateSync } from "node:zlib";

const [furrow, meshes, page, out] = process.argv.slice(2);
export { furrow, meshes, out };
const browserAt = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
if (!browserAt) {
  console.log("skipped: there is no Chromium (Debian's package chromium)");
  process.exit(77);
}
const packages = createRequire(join(page, "package.json"));
const { chromium } = packages("playwright-core");
const axeSource = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");
export const scratch = mkdtempSync(join(tmpdir(), "furrow-studio-"));
mkdirSync(out, { recursive: true });
const running = [];

/** Starts the studio and resolves to its address, or fails with what it said. */
export function studio(...words) {
  const program = spawn(furrow, ["studio", ...words, "--no-browser"], { cwd: scratch });
  running.push(program);
  let said = "";
  return new Promise((resolve, reject) => {
    const hear = (data) => {
      said += data;
      const url = /http:\/\/\S+/.exec(said);
      if (url) resolve({ program, url: url[0] });
    };
    program.stdout.on("data", hear);
    program.stderr.on("data", hear);
    program.on("exit", (code) => reject(new Error(`furrow studio ended with ${code}: ${said}`)));
  });
}

const browser = await chromium.launch({
  executablePath: browserAt,
  args: ["--no-sandbox", "--headless", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--webgl-antialiasing-mode=none"],  // as the processor draws all pictures, which takes most of a test's time
});

/** Polled from here: the page's policy has no eval, which waitForFunction would need. */
export async function until(what, holds, minutes = 4) {
  const end = Date.now() + 60000 * minutes;  // a machine may have much else to do
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() > end) throw new Error(`waited ${minutes} minutes for: ${what}`);
    await new Promise((r) => setTimeout(r, 50));
  }
}

/** Opens the page, and waits for so many meshes: the cloth, and a body where there is one. The layout is that of 1,200 x 800;
 * the picture has a quarter of the pixels, since the processor draws it, unless thin lines are looked for (`scale` 1). */
export async function open(url, meshesShown = 2, scale = 0.5) {
  const tab = await browser.newPage({ viewport: { width: 1200, height: 800 }, deviceScaleFactor: scale });
  const faults = [];
  tab.on("pageerror", (e) => faults.push(String(e)));
  tab.on("console", (m) => m.type() === "error" && faults.push(m.text()));
  const asked = new Set();  // what the program has not answered yet
  tab.on("websocket", (socket) => {
    const idOf = ({ payload }) => (typeof payload === "string" ? JSON.parse(payload).id : undefined);
    socket.on("framesent", (frame) => asked.add(idOf(frame)));
    socket.on("framereceived", (frame) => asked.delete(idOf(frame)));
  });
  await tab.goto(url);
  const foot = (name) => tab.locator("footer").getAttribute(`data-${name}`);
  const seen = {
    tab, faults,
    step: async () => Number(await foot("step")),
    lines: async () => Number(await foot("lines")),
    words: () => tab.locator("footer .say").innerText(),
    shot: (name) => tab.screenshot({ path: join(out, `${name}.png`) }),
    answered: () => until("an answer", async () => asked.size === 0 && (await tab.waitForTimeout(40), asked.size === 0)),
    at: (step) => until(`step ${step}`, async () => Number(await foot("step")) === step),
    /** The canvas' pixels as they are shown. */
    pixels: async () => {  // of the page: the canvas alone is waited for to hold still, which it may not
      const clip = await tab.locator("canvas").boundingBox();
      return (await tab.screenshot({ clip })).toString("base64");
    },
  };
  await until("the cloth", async () => Number(await foot("frames")) >= meshesShown);
  await tab.waitForTimeout(500);
  return seen;
}

/** Draws with the button held down, from point to point [share of the canvas]. */
export async function stroke(tab, points) {
  const box = await tab.locator("canvas").boundingBox();
  const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  await tab.mouse.move(...at(points[0]));
  await tab.mouse.down();
  for (const p of points.slice(1)) await tab.mouse.move(...at(p), { steps: 12 });
  return async () => tab.mouse.up();
}

export const strokesIn = (folder) => JSON.parse(readFileSync(join(scratch, folder, "strokes.json"), "utf8")).strokes;

/** The picture, once its lines have faded, no finer one is to come, and it stays the same: a slow machine draws later. */
export async function still(seen) {
  await until("the lines have faded, and all is drawn", async () => (await seen.tab.locator("canvas:is([data-fresh], [data-due])").count()) === 0);
  let last = await seen.pixels();
  await until("the picture holds still", async () => {
    await seen.tab.waitForTimeout(400);
    const now = await seen.pixels(), same = now === last;
    last = now;
    return same;
  });
  return last;
}

/** What axe-core finds that is serious, in light and in dark; it is run from outside, as the page's policy has no eval. */
export async function accessible(seen, what) {
  for (const colorScheme of ["light", "dark"]) {
    await seen.tab.emulateMedia({ colorScheme });
    await seen.tab.evaluate(axeSource);
    const found = await seen.tab.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
    const grave = found.violations.filter((v) => v.impact === "serious" || v.impact === "critical")
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(" | ")}`);
    assert.deepEqual(grave, [], `${what}, ${colorScheme}`);
  }
  await seen.shot(`dark-${what}`);
  await seen.tab.emulateMedia({ colorScheme: "light" });
}

/** The canvas as it is seen: its size, and red, green and blue of the pixel at a share of it. */
export async function picture({ tab }) {
  const png = await tab.screenshot({ clip: await tab.locator("canvas").boundingBox() }), parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const width = png.readUInt32BE(16), height = png.readUInt32BE(20), size = png[25] === 6 ? 4 : 3, row = size * width;
  const rows = inflateSync(Buffer.concat(parts)), bytes = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y)
    for (let i = 0; i < row; ++i) {  // each row as the PNG's filter of its own left it
      const a = i < size ? 0 : bytes[y * row + i - size], b = y ? bytes[(y - 1) * row + i] : 0, c = y && i >= size ? bytes[(y - 1) * row + i - size] : 0;
      const p = a + b - c, near = [a, b, c].reduce((best, v) => (Math.abs(p - v) < Math.abs(p - best) ? v : best), a);
      bytes[y * row + i] = rows[y * (row + 1) + 1 + i] + [0, a, b, (a + b) >> 1, near][rows[y * (row + 1)]];
    }
  const at = (x, y) => size * (Math.min(width - 1, Math.floor(x * width)) + width * Math.min(height - 1, Math.floor(y * height)));
  return { width, height, colour: (x, y) => [...bytes.subarray(at(x, y), at(x, y) + 3)] };
}

/** An upright sheet of n x n quads as OBJ. */
export function sheetText(n, edge) {
  const lines = [];
  for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) lines.push(`v ${((i - n / 2) * edge).toFixed(4)} ${(j * edge).toFixed(4)} 0`);
  const at = (i, j) => j * (n + 1) + i + 1;
  for (let j = 0; j < n; ++j) for (let i = 0; i < n; ++i) lines.push(`f ${at(i, j)} ${at(i + 1, j)} ${at(i + 1, j + 1)} ${at(i, j + 1)}`);
  return lines.join("\n") + "\n";
}

/** What the project's log says is done again, and ends in the same bits. */
export function replay(folder) {
  const done = spawnSync(furrow, ["studio", "--replay", folder, "--headless"], { cwd: scratch, encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
  assert.match(done.stdout, /same bits/);
}

/** Ends a program as Ctrl-C does, and requires that it says it went well. */
export async function end(program) {
  program.removeAllListeners("exit");
  const ended = new Promise((resolve) => program.on("exit", resolve));
  program.kill("SIGINT");
  assert.equal(await ended, 0);
}

/** Does the test, and leaves nothing behind. A browser on a busy machine may be late: what fails is done once more, from a
 * new start, and said. */
export async function run(test) {
  try {
    await test().catch(async (first) => {
      console.log(`failed, and is done once more: ${first.stack}`);
      for (const program of running.splice(0)) program.removeAllListeners("exit").kill("SIGKILL");
      for (const context of browser.contexts()) await context.close();
      for (const name of readdirSync(scratch)) rmSync(join(scratch, name), { recursive: true });
      await test();
    });
    console.log("1 passed, 0 failed");
  } finally {
    for (const program of running) program.kill("SIGKILL");
    await browser.close();
    rmSync(scratch, { recursive: true, force: true });
  }
}
