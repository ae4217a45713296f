// SPDX-License-Identifier: GPL-3.0-or-later
// How long the studio takes from a hand's move until it is seen: times.mjs FURROW PAGE GARMENT [BODY], which holds it. PAGE is the folder
// whose node_modules has playwright-core (build/release/page). Each row is the median of 20 in a real Chromium, and the
// least, from the event in the page to the second picture after what the program answered, and to its mesh alone, which no
// slow picture adds to; beside them the share of the machine that was idle meanwhile, without which no time means much.
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { start } from "./start.mjs";

const [furrow, page, garment, body] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(page), "package.json"))("playwright-core");
const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
const scratch = mkdtempSync(join(tmpdir(), "furrow-times-"));
const repeats = 20;

const { program, url } = await start(furrow, garment, body, scratch, !body);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--headless", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });

/** Idle and all ticks of the machine so far. */
const ticks = () => {
  const [, ...n] = readFileSync("/proc/stat", "utf8").split("\n")[0].split(/\s+/).map(Number);
  return { idle: n[3] + n[4], all: n.reduce((a, b) => a + (b || 0), 0) };
};
const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];

try {
  const tab = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  await tab.goto(url);
  const attribute = (name) => tab.locator("footer").getAttribute(`data-${name}`);
  const until = async (holds) => {
    for (const end = Date.now() + 60000; !(await holds()); await new Promise((r) => setTimeout(r, 20)))
      if (Date.now() > end) throw new Error("waited a minute");
  };
  await until(async () => Number(await attribute("frames")) >= (body ? 2 : 1));
  // From the next event of a kind until a later mesh has been drawn twice.
  await tab.evaluate(() => {
    globalThis.timeFrom = (kind) => {
      globalThis.took = undefined;
      const foot = document.querySelector("footer");
      addEventListener(kind, () => {
        const start = performance.now(), frames = foot.dataset.frames;
        const look = () => {
          if (foot.dataset.frames === frames) return requestAnimationFrame(look);
        globalThis.meshTook = performance.now() - start;
          requestAnimationFrame(() => requestAnimationFrame(() => (globalThis.took = performance.now() - start)));
        };
        look();
      }, { capture: true, once: true });
    };
  });
  const box = await tab.locator("canvas").boundingBox();
  const row = async (what, kind, act, after = async () => undefined) => {
    const list = [], meshes = [], before = ticks();
    for (let i = 0; i < repeats; ++i) {
      await tab.evaluate((k) => globalThis.timeFrom(k), kind);
      await act(i);
      await until(() => tab.evaluate(() => globalThis.took !== undefined));
      list.push(await tab.evaluate(() => globalThis.took));
      meshes.push(await tab.evaluate(() => globalThis.meshTook));
      await after();
    }
    const now = ticks();
    const idle = Math.round((100 * (now.idle - before.idle)) / (now.all - before.all));
    console.log(`${what}: ${Math.round(median(list))} ms (least ${Math.round(list[0])}), its mesh ${Math.round(median(meshes))} ms (least ${Math.round(meshes[0])}), ${idle} % idle`);
  };
  const settled = () => tab.waitForTimeout(150);
  const undo = async () => {
    const step = Number(await attribute("step"));
    await tab.keyboard.press("Control+z");
    await until(async () => Number(await attribute("step")) === step - 1);
    await settled();
  };
  const line = async (x) => {
    await tab.mouse.move(box.x + x * box.width, box.y + 0.45 * box.height);
    await tab.mouse.down();
    await tab.mouse.move(box.x + x * box.width, box.y + 0.62 * box.height, { steps: 12 });
    await tab.mouse.up();
  };
  await tab.keyboard.press("r");
  await row("pen up to wrinkle seen", "pointerup", () => line(0.52), undo);
  await line(0.52);
  await until(async () => Number(await attribute("lines")) === 1);
  await tab.keyboard.press("Escape");
  await settled();
  const slider = tab.locator("aside input[type=range]").first();
  await row("slider to seen", "input", (i) => slider.evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, 12 + i), settled);
  await tab.locator("canvas").focus();
  let redo = false;
  await row("undo, redo", "keydown", () => tab.keyboard.press((redo = !redo) ? "Control+z" : "Control+y"), settled);

  // A frame while it moves: the time of a step of 1/60 s, its picture included, over four seconds.
  const still = Number(await attribute("step"));
  await tab.keyboard.press("Space");
  const moved = async () => Number((await tab.locator("[data-time]").getAttribute("data-time").catch(() => null)) ?? 0);
  await until(async () => (await tab.locator("[data-time]").count()) > 0 && (await moved()) > 0.05);
  const before = ticks(), from = { at: performance.now(), time: await moved() };
  await tab.waitForTimeout(4000);
  const steps = 60 * ((await moved()) - from.time), took = performance.now() - from.at, now = ticks();
  await tab.keyboard.press("Space");
  await until(async () => Number(await attribute("step")) === still + 1);
  console.log(`a frame while it moves: ${Math.round(took / steps)} ms, ${Math.round((100 * (now.idle - before.idle)) / (now.all - before.all))} % idle`);
  while (Number(await attribute("step")) > 0) await undo();  // without a line
  const drapes = [];
  for (let i = 0; i < 3; ++i) {
    const step = Number(await attribute("step")), began = performance.now();
    await tab.keyboard.press("d");
    for (const end = Date.now() + 200000; Number(await attribute("step")) === step && Date.now() < end;) await new Promise((r) => setTimeout(r, 20));
    drapes.push(performance.now() - began);
    await undo();
  }
  console.log(`drape: ${(median(drapes) / 1000).toFixed(2)} s (median of 3)`);
} finally {
  program.removeAllListeners("exit");
  program.kill("SIGINT");
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
