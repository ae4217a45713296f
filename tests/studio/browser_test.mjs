// SPDX-License-Identifier: GPL-3.0-or-later
// The studio in a real browser, by pointer and keys: browser_test.mjs FURROW MESHES PAGE OUT. Opens a skirt on its
// body, draws a ridge, sees it, changes its height, draws over it, undoes all, saves, and opens the folder again.
// Pictures of the steps are kept in OUT. PAGE is the folder whose node_modules has playwright-core. Ends with 77,
// which ctest counts as skipped, where there is no Chromium.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [furrow, meshes, page, out] = process.argv.slice(2);
const browserAt = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
if (!browserAt) {
  console.log("skipped: there is no Chromium (Debian's package chromium)");
  process.exit(77);
}
const { chromium } = createRequire(join(page, "package.json"))("playwright-core");
const scratch = mkdtempSync(join(tmpdir(), "furrow-studio-"));
mkdirSync(out, { recursive: true });
const running = [];

/** Starts the studio and resolves to its address, or fails with what it said. */
function studio(...words) {
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
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

/** Polled from here: the page's policy has no eval, which waitForFunction would need. */
async function until(what, holds) {
  const end = Date.now() + 60000;
  for (;;) {
    const found = await holds();
    if (found) return found;
    if (Date.now() > end) throw new Error(`waited a minute for: ${what}`);
    await new Promise((r) => setTimeout(r, 50));
  }
}

async function open(url) {
  const tab = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  const faults = [];
  tab.on("pageerror", (e) => faults.push(String(e)));
  tab.on("console", (m) => m.type() === "error" && faults.push(m.text()));
  await tab.goto(url);
  const foot = (name) => tab.locator("footer").getAttribute(`data-${name}`);
  const seen = {
    tab, faults,
    step: async () => Number(await foot("step")),
    lines: async () => Number(await foot("lines")),
    words: () => tab.locator("footer .say").innerText(),
    shot: (name) => tab.screenshot({ path: join(out, `${name}.png`) }),
    at: (step) => until(`step ${step}`, async () => Number(await foot("step")) === step),
    /** The canvas' pixels as they are shown. */
    pixels: async () => (await tab.locator("canvas").screenshot()).toString("base64"),
  };
  await until("the cloth", async () => Number(await foot("frames")) >= 2);
  await tab.waitForTimeout(500);
  return seen;
}

/** Draws with the button held down, from point to point [share of the canvas]. */
async function stroke(tab, points) {
  const box = await tab.locator("canvas").boundingBox();
  const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  await tab.mouse.move(...at(points[0]));
  await tab.mouse.down();
  for (const p of points.slice(1)) await tab.mouse.move(...at(p), { steps: 12 });
  return async () => tab.mouse.up();
}

const strokesIn = (folder) => JSON.parse(readFileSync(join(scratch, folder, "strokes.json"), "utf8")).strokes;

async function drawAndUndo(seen) {
  const { tab } = seen;
  assert.equal(await seen.lines(), 0);
  const before = await seen.pixels();
  await seen.shot("1-open");
  await tab.keyboard.press("r");
  await tab.locator("header input[type=range]").first().fill("18");
  const up = await stroke(tab, [[0.53, 0.3], [0.53, 0.55], [0.54, 0.84]]);
  await seen.shot("2-drawing");
  await up();
  await seen.at(1);
  await tab.waitForTimeout(600);
  assert.equal(await seen.lines(), 1);
  assert.notEqual(await seen.pixels(), before, "a drawn ridge is seen");
  await seen.shot("3-ridge");

  await tab.keyboard.press("v");
  await (await stroke(tab, [[0.42, 0.32], [0.4, 0.84]]))();
  await seen.at(2);
  assert.match(await tab.locator("aside").innerText(), /valley 1/);

  const ridge = await seen.pixels();
  await tab.locator("aside input[type=range]").first().fill("25");
  await seen.at(3);
  await tab.waitForTimeout(600);
  assert.notEqual(await seen.pixels(), ridge, "another height is seen");
  await seen.shot("4-height");
  await tab.keyboard.press("Control+s");
  await until("saved", async () => (await seen.words()).startsWith("Saved"));

  for (let step = 2; step >= 0; --step) {
    await tab.keyboard.press("Control+z");
    await seen.at(step);
  }
  await tab.waitForTimeout(600);
  assert.equal(await seen.lines(), 0);
  await tab.keyboard.press("Escape");
  await tab.mouse.move(5, 5);
  await tab.waitForTimeout(300);
  for (let step = 1; step <= 3; ++step) {
    await tab.keyboard.press("Control+y");
    await seen.at(step);
  }
}

async function refuse(seen) {
  await seen.tab.keyboard.press("r");
  await (await stroke(seen.tab, [[0.5, 0.5], [0.502, 0.502]]))();
  await until("a word on a line that is too short", async () => /too short/.test(await seen.words()));
  assert.equal(await seen.step(), 3);
  await seen.tab.keyboard.press("Escape");
}

async function drape(seen) {
  await seen.tab.keyboard.press("d");
  await seen.at(4);
  await until("it tells how the drape ended", async () => /at rest/.test(await seen.words()));
  await seen.tab.waitForTimeout(500);
  await seen.shot("5-draped");
  await seen.tab.keyboard.press("Control+z");
  await seen.at(3);
}

/** The picture, once it stays the same for a while: a slow machine draws later. */
async function still(seen) {
  let last = await seen.pixels();
  await until("the picture holds still", async () => {
    await seen.tab.waitForTimeout(400);
    const now = await seen.pixels(), same = now === last;
    last = now;
    return same;
  });
  return last;
}

/** The colours of the fit, and the cloth's own again. */
async function fit(seen) {
  const press = async () => {
    await seen.tab.getByRole("button", { name: "Distance" }).click();
    await until("the words of the fit", async () => /nearer than/.test(await seen.words()));
  };
  const becomes = (what, picture) => until(what, async () => (await seen.pixels()) === picture);
  await press();  // its words take a line more, so the picture is smaller from now on
  await seen.shot("8-fit");
  const coloured = await still(seen);
  await press();
  await until("the colours go", async () => (await seen.pixels()) !== coloured);
  const plain = await still(seen);
  await press();
  await becomes("the fit is seen again", coloured);
  await press();
  await becomes("the cloth's own colour comes back", plain);
}

/** Play, pause, play on, and a pen that is picked up while the cloth moves makes it hold still. */
async function play(seen) {
  const { tab } = seen;
  const time = async () => Number(await tab.locator("[data-time]").getAttribute("data-time"));
  const before = await seen.pixels();
  await tab.locator("canvas").focus();
  await tab.keyboard.press("Space");
  await until("the cloth moves", async () => (await tab.locator("[data-time]").count()) > 0 && (await time()) > 0.2);
  const moving = await seen.pixels();
  assert.notEqual(moving, before, "the cloth is seen to move");
  await tab.keyboard.press("Space");
  await seen.at(4);
  // The step is told before the answer to the play that made it.
  await until("it tells how long", async () => /has moved for/.test(await seen.words()));
  await tab.waitForTimeout(200);
  const paused = await time();
  await tab.keyboard.press("Space");
  await until("it goes on", async () => (await time()) > paused + 0.1);
  await tab.keyboard.press("r");
  await seen.at(5);
  await tab.waitForTimeout(600);
  await (await stroke(tab, [[0.53, 0.35], [0.53, 0.6], [0.54, 0.8]]))();
  await seen.at(6);
  await tab.waitForTimeout(600);
  await tab.keyboard.press("Escape");
  await seen.shot("6-played");
  for (let step = 5; step >= 3; --step) {
    await tab.keyboard.press("Control+z");
    await seen.at(step);
  }
}

try {
  const first = await studio(join(meshes, "skirt.obj"), "--body", join(meshes, "mannequin.obj"), "--pin-loop", "top");
  const seen = await open(first.url);
  await drawAndUndo(seen);
  await refuse(seen);
  await drape(seen);
  await fit(seen);
  await play(seen);
  assert.ok(!seen.tab.url().includes("token"), "the token leaves the address");
  const strokes = strokesIn("skirt-studio");
  assert.equal(strokes.length, 2);
  assert.ok(strokes[0].height > 0 && strokes[1].height < 0);
  assert.deepEqual(seen.faults, []);
  first.program.removeAllListeners("exit");
  const ended = new Promise((r) => first.program.on("exit", r));
  first.program.kill("SIGINT");
  assert.equal(await ended, 0);

  const again = await open((await studio("skirt-studio")).url);
  assert.equal(await again.step(), 3);
  assert.equal(await again.lines(), 2);
  await again.shot("7-again");
  assert.deepEqual(again.faults, []);
  console.log("1 passed, 0 failed");
} finally {
  for (const program of running) program.kill("SIGKILL");
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
