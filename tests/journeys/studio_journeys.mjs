// SPDX-License-Identifier: GPL-3.0-or-later
// Ways through the studio in a real browser (tests/studio/browser.mjs). Two lead from `furrow studio` with no argument to
// a drawing that is opened again: with a skirt of the gallery, whose log is replayed, and with a dress in centimetres, z
// up, and its body, as files of one's own. All buttons are pressed in each state of the skirt, and in the first and the last
// of the dress, and the picture is looked at. The third is a new user's first minute: five ridges, drawn by mouse, that
// stand at rest.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, end, furrow, meshes, open, picture, replay, run, scratch, still, stroke, studio, until } from "../studio/browser.mjs";

/** What a button may say against being pressed where it has nothing to do. */
const mayRefuse = { Keep: /no line to keep/, Maps: /texture coordinates/, "Moving GLB": /nothing has moved|cannot be done again/, PC2: /nothing has moved|cannot be done again/, Mirror: /lies in the middle/ };

const isTool = /^(Look|Ridge|Valley|Pin|Touch)$/;  // of which one is always taken up

const difference = (a, b) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));

/** The share of the canvas where cloth is seen, which is beige; the body is grey, and the ground blue. */
async function shareOfCloth(seen) {
  const { colour } = await picture(seen);
  const places = Array.from({ length: 2500 }, (_, i) => colour(((i % 50) + 0.5) / 50, (Math.floor(i / 50) + 0.5) / 50));
  return places.filter(([red, , blue]) => red > blue + 15).length / places.length;
}

const changedAt = (before, after, places) =>
  places.filter(([x, y]) => difference(before.colour(x, y), after.colour(x, y)) > 4).length / places.length;

/** Shares of the canvas in a grid, without the rows of hints above and of buttons below. */
const everywhere = Array.from({ length: 400 }, (_, i) => [((i % 20) + 0.5) / 20, 0.2 + 0.7 * ((Math.floor(i / 20) + 0.5) / 20)]);

/** Places beside a stroke, where its fold casts light and shadow but neither line nor dots are drawn. */
function besideStroke(points) {
  const beside = [-0.05, -0.04, -0.03, -0.02, 0.02, 0.03, 0.04, 0.05], [from, to] = [points[0], points.at(-1)];
  return Array.from({ length: 160 }, (_, i) => {
    const t = (Math.floor(i / 8) + 0.5) / 20;
    return [from[0] + t * (to[0] - from[0]) + beside[i % 8], from[1] + t * (to[1] - from[1])];
  });
}

/** Places away from a stroke, its line and its dots. */
function awayFromStroke(points) {
  const [across, down] = [0, 1].map((axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))]);
  return everywhere.filter(([x, y]) => x < across[0] - 0.08 || x > across[1] + 0.08 || y < down[0] - 0.08 || y > down[1] + 0.08);
}

/** The cloth from the front, whatever was looked at before. */
async function fromTheFront(seen) {
  await seen.tab.getByRole("button", { name: "Front", exact: true }).click();
  await seen.tab.mouse.move(5, 5);
  await still(seen);
}

/** What takes long has made a step, and nothing was said against it. */
async function done(seen, step) {
  const bad = seen.tab.locator("footer .say.bad");
  await until(`step ${step}`, async () => (await seen.step()) === step || (await bad.count()) > 0, 15);
  assert.equal(await seen.step(), step, (await bad.allInnerTexts()).join());
}

/** Back to the step where the state was. */
async function backTo(seen, step) {
  for (let at; (at = await seen.step()) !== step;) {
    await seen.tab.keyboard.press(at > step ? "Control+z" : "Control+y");
    await seen.at(at > step ? at - 1 : at + 1);
    await seen.answered();
  }
}

/** Presses one button: no fault in the page, no word against it that is not expected, and it can be taken back. */
async function press(seen, state, name) {
  const { tab } = seen, step = await seen.step();
  const button = tab.locator("header, main, aside, footer").getByRole("button", { name, exact: true }).first();
  if ((await button.count()) === 0 || !(await button.isEnabled())) return false;
  const was = await button.getAttribute("aria-pressed");
  await button.click();
  await seen.answered();
  const bad = await tab.locator("footer .say.bad").allInnerTexts();
  for (const words of bad) assert.match(words, mayRefuse[name] ?? /^$/, `${state}: ${name}`);
  assert.deepEqual(seen.faults, [], `${state}: ${name}`);
  if ((await tab.locator("dialog").count()) > 0) await tab.keyboard.press("Escape");
  await until(`${state}: ${name} leaves no dialog`, async () => (await tab.locator("dialog").count()) === 0);
  if (was !== null && !isTool.test(name) && (await button.count()) && (await button.getAttribute("aria-pressed")) !== was) await button.click();
  await seen.answered();
  await tab.keyboard.press("Escape");
  await backTo(seen, step);
  return true;
}

/** All buttons that there are in a state, but for those that the journey presses itself. Swatches differ in numbers alone:
 * where the cloth is bare all are pressed, then one. */
async function pressAll(seen, state, ...but) {
  const names = await seen.tab.locator("header, main, aside, footer").getByRole("button").evaluateAll((list, isBare) =>
    list.filter((b) => !b.disabled && (isBare || !b.matches('[aria-label="Fabric"] :is([aria-pressed=true], [aria-pressed=false] ~ *)')))
      .map((b) => b.getAttribute("aria-label") ?? b.textContent.trim()), state.endsWith("bare"));
  const pressed = [];
  for (const name of new Set(names))
    if (!but.includes(name) && (await press(seen, state, name))) pressed.push(name);
  console.log(`${state}: ${pressed.length} buttons`);
  assert.ok(pressed.length > 15, `${state}: ${pressed}`);
}

/** A ridge by the pen, whose fold is seen where it was drawn, and is not where the line is switched off. */
async function draw(seen, points, lines) {
  const { tab } = seen, step = await seen.step();
  await fromTheFront(seen);
  await tab.keyboard.press("r");
  await (await stroke(tab, points))();
  await seen.at(step + 1);
  assert.equal(await seen.lines(), lines);
  await tab.keyboard.press("Escape");
  await tab.keyboard.press("l");  // its stitches are not what is looked for
  await tab.locator("aside .lines input[type=checkbox]").last().uncheck();
  await seen.at(step + 2);
  await still(seen);
  const off = await picture(seen);
  await tab.keyboard.press("Control+z");
  await seen.at(step + 1);
  await seen.answered();
  await still(seen);
  const on = await picture(seen), there = changedAt(off, on, besideStroke(points)), away = changedAt(off, on, awayFromStroke(points));
  await tab.keyboard.press("l");
  assert.ok(there > 0.02 && there > 5 * away, `the fold is seen: ${there} of the places beside its line have changed, and ${away} of those away from it`);
}

/** Plays for so long of the motion's own time [s], then pauses. */
async function play(seen, seconds) {
  const { tab } = seen, step = await seen.step();
  await tab.locator("canvas").focus();
  await tab.keyboard.press("Space");
  await until("the cloth moves", async () => Number((await tab.locator("[data-time]").count()) && (await tab.locator("[data-time]").getAttribute("data-time"))) >= seconds);
  await tab.keyboard.press("Space");
  await seen.at(step + 1);
  await until("it tells how long", async () => /has moved for/.test(await seen.words()));
}

const isAtRest = async (seen) => until("it tells how the drape ended", async () => /at rest/.test(await seen.words()));

/** From the open garment to the drawing that is opened again. `strokes`: shares of the canvas. `isWhole`: all buttons are
 * pressed in all states, lines are kept, and the log is replayed; else *Keep* is cancelled on its way. */
async function journey(first, seen, { folder, strokes, isWhole }) {
  const { tab } = seen, shot = (name) => seen.shot(`${folder}-${name}`);
  assert.equal(await tab.locator("h1").innerText(), folder);
  await still(seen);
  assert.ok((await shareOfCloth(seen)) > 0.05, "the cloth is seen");
  await shot("1-open");
  await pressAll(seen, `${folder}, bare`, "Drape", "Play", ...(isWhole ? [] : ["Turn"]));
  await draw(seen, strokes[0], 1);
  await draw(seen, strokes[1], 2);
  await shot("2-drawn");
  if (isWhole) await pressAll(seen, `${folder}, drawn`, "Keep", "Drape", "Play", "Look", "Turn");
  let step = await seen.step();
  await tab.keyboard.press("k");
  if (isWhole) {
    await done(seen, ++step);
    await until("the verdicts", async () => (await tab.locator(".verdicts li").count()) === 2);
    await fromTheFront(seen);
    await shot("3-kept");
    await pressAll(seen, `${folder}, kept`, "Keep", "Drape", "Drape it", "Accept", "Play", "Turn");
    await until("the verdicts again", async () => (await tab.locator(".verdicts li").count()) === 2);
    await tab.getByRole("button", { name: "Drape it", exact: true }).click();
  } else {
    await tab.getByRole("button", { name: "Cancel", exact: true }).click();
    await until("it has stopped", async () => /stopped; nothing was changed/.test(await seen.words()));
    await tab.keyboard.press("d");
  }
  await done(seen, ++step);
  await isAtRest(seen);
  await fromTheFront(seen);
  assert.ok((await shareOfCloth(seen)) > 0.05, "the draped cloth is seen");
  await shot("4-draped");
  const resting = await picture(seen);
  if (isWhole) await pressAll(seen, `${folder}, at rest`, "Keep", "Drape", "Play", "Turn");
  await fromTheFront(seen);
  await play(seen, 0.5);
  await seen.at(++step);
  await draw(seen, strokes[2], 1);
  ++step;
  await shot("5-played");
  await pressAll(seen, `${folder}, played`, "Keep", "Drape", "Play", "Undo", "Moving GLB", "PC2", "Turn");
  for (const back of [1, 2]) {
    await tab.getByRole("button", { name: "Undo", exact: true }).click();
    await seen.at(step - back);
  }
  step -= 2;
  await fromTheFront(seen);
  assert.ok(changedAt(resting, await picture(seen), everywhere) < 0.02, "the cloth is seen as it was at rest");
  await tab.getByRole("button", { name: "Save", exact: true }).click();
  await until("saved", async () => (await seen.words()).startsWith("Saved"));
  const second = spawnSync(furrow, ["studio", folder, "--no-browser"], { cwd: scratch, encoding: "utf8", timeout: 60000 });
  assert.equal(second.status, 1, "a second studio on the project is refused");
  assert.match(second.stderr, /is open in another studio/);
  await end(first.program);
  await tab.close();
  await openAgain(folder, step);
  if (isWhole) replayBesideOnesOwn(folder);
}

/** The drawing as it was left. */
async function openAgain(folder, step) {
  const again = await studio(folder), seen = await open(again.url);
  assert.equal(await seen.step(), step);
  await still(seen);
  assert.ok((await shareOfCloth(seen)) > 0.05, "the cloth is seen again");
  await seen.shot(`${folder}-6-again`);
  await seen.tab.keyboard.press("Control+z");
  await seen.at(step - 1);
  await seen.tab.keyboard.press("Control+y");
  await seen.at(step);
  assert.deepEqual(seen.faults, []);
  await end(again.program);
  await seen.tab.close();
}

/** The replay of its log ends in the same bits, and touches nothing of the user's. */
function replayBesideOnesOwn(folder) {
  mkdirSync(join(scratch, folder, "replay"));
  writeFileSync(join(scratch, folder, "replay", "mine.txt"), "mine");
  replay(folder);
  assert.equal(readFileSync(join(scratch, folder, "replay", "mine.txt"), "utf8"), "mine");
}

/** Opens the skirt of the gallery. */
async function openSkirt(seen, look = async () => {}) {
  const dialog = seen.tab.locator("dialog.open");
  await until("the gallery", async () => (await dialog.getByRole("button").count()) > 3);
  await look(dialog);
  await dialog.getByRole("button", { name: "A skirt on a figure", exact: true }).click();
  await until("the skirt", async () => Number(await seen.tab.locator("footer").getAttribute("data-frames")) >= 2 && (await dialog.count()) === 0);
}

async function fromTheGallery() {
  const first = await studio(), seen = await open(first.url, 0);
  await openSkirt(seen, async (dialog) => {
    await accessible(seen, "gallery");
    await seen.shot("13-gallery");
    assert.ok(await dialog.getByRole("button", { name: "Open", exact: true }).isDisabled(), "nothing is chosen");
  });
  const strokes = [[[0.53, 0.3], [0.53, 0.55], [0.54, 0.84]], [[0.42, 0.32], [0.4, 0.84]], [[0.48, 0.4], [0.48, 0.8]]];
  await journey(first, seen, { folder: "skirt-studio", strokes, isWhole: true });
}

/** The mannequin in the frame of meshes/dress_cm.obj. */
function bodyOfDress() {
  return readFileSync(join(meshes, "mannequin.obj"), "utf8").split("\n").map((line) => {
    const [word, x, y, z] = line.split(" ");
    return word === "v" ? `v ${100 * x} ${-100 * z} ${100 * y}` : line;
  }).filter((line) => !line.startsWith("vn")).join("\n");
}

async function ofOnesOwn() {
  writeFileSync(join(scratch, "dress.obj"), readFileSync(join(meshes, "dress_cm.obj")));
  writeFileSync(join(scratch, "figure.obj"), bodyOfDress());
  const first = await studio(), seen = await open(first.url, 0), dialog = seen.tab.locator("dialog.open");
  await until("the gallery", async () => (await dialog.getByRole("button").count()) > 3);
  await dialog.getByLabel("Garment").setInputFiles(join(scratch, "dress.obj"));
  await dialog.getByLabel("Body").setInputFiles(join(scratch, "figure.obj"));
  await dialog.getByRole("button", { name: "Open", exact: true }).click();
  await until("the dress", async () => Number(await seen.tab.locator("footer").getAttribute("data-frames")) >= 2 && (await dialog.count()) === 0);
  await until("it tells what it was taken for", async () => /Taken as cm with z upwards, so the body is 1\.\d\d m tall/.test(await seen.words()));
  const strokes = [[[0.56, 0.52], [0.58, 0.86]], [[0.45, 0.52], [0.43, 0.86]], [[0.51, 0.55], [0.51, 0.86]]];
  await journey(first, seen, { folder: "dress-studio", strokes, isWhole: false });  // it takes minutes
}

/** What a PLY holds, whatever its header says of where it comes from. */
const content = (path) => readFileSync(path).toString("latin1").split("end_header\n")[1];

/** By mouse alone: five ridges on the gallery's skirt stand as they were drawn when the cloth has come to rest. */
async function fiveRidges() {
  const first = await studio(), seen = await open(first.url, 0), { tab } = seen;
  const press = (name) => tab.getByRole("button", { name, exact: true }).click();
  await openSkirt(seen);
  await still(seen);
  await press("Ridge");
  for (const [i, x] of [0.34, 0.42, 0.5, 0.58, 0.66].entries()) {
    await (await stroke(tab, [[0.5 + 0.7 * (x - 0.5), 0.36], [x, 0.84]]))();
    await seen.at(i + 1);
  }
  await press("Drape");
  await done(seen, 6);
  await isAtRest(seen);
  assert.doesNotMatch(await seen.words(), /lost|lower than/);
  await still(seen);
  await seen.shot("19-five-ridges");
  await press("Save");
  await until("saved", async () => (await seen.words()).startsWith("Saved"));
  await end(first.program);
  await tab.close();
  checkRidges(join(scratch, "skirt-studio"));
}

/** The command line draws the strokes of the page's log to the same bits, and measures them. */
function checkRidges(project) {
  const steps = readFileSync(join(project, "log.jsonl"), "utf8").trim().split("\n").map((line) => JSON.parse(line));
  const strokes = steps.filter((step) => step.do === "draw").map(({ height, points }, i) => ({ name: `ridge ${i + 1}`, height, points }));
  assert.deepEqual(strokes.map(({ height }) => height), Array(5).fill(0.02));
  writeFileSync(join(scratch, "five.json"), JSON.stringify({ strokes }));
  const again = spawnSync(furrow, ["wrinkle", join(meshes, "skirt.obj"), "five.json", "--settle", "--body", join(meshes, "mannequin.obj"), "--pin-loop", "top", "-o", "five.ply", "--json"], { cwd: scratch, encoding: "utf8" });
  assert.equal(again.status, 0, again.stderr);
  assert.ok(content(join(project, "rest-1.ply")) === content(join(scratch, "five.ply")), "the same bits");
  for (const { name, kept } of JSON.parse(again.stdout).at_rest.lines) assert.ok(kept > 0.8 && kept < 1.3, `${name} kept ${kept}`);
  rmSync(project, { recursive: true });
}

await run(async () => {
  const only = process.argv[6];  // "ridges", "gallery" or "own": one of them
  if (!only || only === "ridges") await fiveRidges();
  if (!only || only === "gallery") await fromTheGallery();
  if (!only || only === "own") await ofOnesOwn();
});
