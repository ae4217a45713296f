// SPDX-License-Identifier: GPL-3.0-or-later
// The studio in a real browser (browser.mjs), by pointer and keys. Opens a skirt on its body, draws, sees it, changes and
// drags lines, plays, pulls, undoes all and saves. On a small sheet: pins, a lasso, order of lines, keep. A skirt made for
// another body. axe-core finds nothing serious, light or dark. tests/journeys/studio_journeys.mjs goes the ways of users.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { accessible, end, furrow, meshes, open, picture, replay, run, scratch, sheetText, still, strokesIn, stroke, studio, until } from "./browser.mjs";

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

/** A line from above the waist to below the hem reaches both; and all lines get another height at once. */
async function reachBordersAndChangeAll(seen) {
  const { tab } = seen;
  const save = async () => {
    await tab.keyboard.press("Control+s");
    await until("saved", async () => (await seen.words()).startsWith("Saved"));
  };
  await tab.keyboard.press("r");
  await (await stroke(tab, [[0.6, 0.1], [0.61, 0.5], [0.62, 0.95]]))();
  await seen.at(4);
  await tab.keyboard.press("Escape");
  await save();
  const { points } = strokesIn("skirt-studio")[2];
  const heights = readFileSync(join(meshes, "skirt.obj"), "utf8").split("\n").filter((l) => l.startsWith("v ")).map((l) => Number(l.split(" ")[2]));
  assert.ok(Math.max(...heights) - points[0][1] < 0.004, `it begins at ${points[0][1]}, and the waist is at ${Math.max(...heights)}`);
  assert.ok(points.at(-1)[1] - Math.min(...heights) < 0.004, `it ends at ${points.at(-1)[1]}, and the hem is at ${Math.min(...heights)}`);
  await tab.getByRole("button", { name: "All 3 lines" }).click();
  await tab.getByRole("group", { name: "All lines" }).getByRole("slider", { name: "Height" }).fill("22");
  await seen.at(5);
  await save();
  assert.deepEqual(strokesIn("skirt-studio").map((s) => s.height), [0.022, -0.022, 0.022]);
  await tab.waitForTimeout(600);
  await seen.shot("17-all-lines");
  await tab.getByText("History", { exact: true }).click();
  const list = tab.getByRole("region", { name: "History" });
  await until("the history tells its steps", async () => /draw ridge 1[^]*draw ridge 2[^]*change the height of 3 lines/.test(await list.innerText()));
  await list.getByRole("button", { name: "draw ridge 2" }).click();
  await seen.at(4);
  await tab.waitForTimeout(600);
  await list.getByRole("button").last().scrollIntoViewIfNeeded();
  await seen.shot("20-history");
  await list.getByRole("button", { name: /change the height of/ }).first().click();
  await seen.at(3);
  await tab.getByText("History", { exact: true }).click();
  await save();
}

/** The chosen line is dragged by a dot in its middle; the way there is seen, and can be taken back. */
async function dragLine(seen) {
  const { tab } = seen, step = await seen.step();
  await tab.locator("aside .name").first().click();
  await tab.waitForTimeout(300);
  const box = await tab.locator("canvas").boundingBox();
  const before = await still(seen);
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  // Dots stand on the line drawn at x = 0.53; one of them is found by trying places along it.
  for (let y = 0.4; y < 0.75; y += 0.015) {
    await tab.mouse.move(...at(0.53, y));
    await tab.mouse.down();
    await tab.mouse.move(...at(0.56, y), { steps: 6 });
    if (await tab.evaluate(() => document.querySelector("footer").dataset.dragging === "true")) break;
    await tab.mouse.up();
  }
  assert.equal(await tab.evaluate(() => document.querySelector("footer").dataset.dragging), "true", "a dot is grabbed");
  await until("the line follows while it is dragged", async () => (await seen.pixels()) !== before);
  assert.equal(await seen.step(), step);
  await seen.shot("9-dragged");
  await tab.mouse.up();
  await seen.at(step + 1);
  await tab.keyboard.press("Control+z");
  await seen.at(step);
  await tab.locator("aside .name").first().click();
}

/** The colours of the fit, and the cloth's own again. */
async function fit(seen) {
  const press = async () => {
    await seen.tab.getByRole("button", { name: "Distance" }).click();
    await until("the words of the fit", async () => /nearer than/.test(await seen.words()));
  };
  const becomes = (what, picture) => until(what, async () => (await seen.pixels()) === picture);
  await press();  // its words take a line more, so the picture is smaller from now on
  await until("far from the body it is yellow", async () => {
    const [red, green, blue] = (await picture(seen)).colour(0.5, 0.5);
    return red > 180 && green > 180 && blue < 150;
  });
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
  await tab.keyboard.press("Space");
  await seen.at(4);
  assert.notEqual(await seen.pixels(), before, "the cloth is seen to have moved");
  // The step is told before the answer to the play that made it.
  await until("it tells how long", async () => /has moved for/.test(await seen.words()));
  await tab.waitForTimeout(200);
  const paused = await time();
  await tab.keyboard.press("Space");
  await until("it goes on", async () => (await time()) > paused + 0.05);
  const box = await tab.locator("canvas").boundingBox();
  await tab.mouse.move(box.x + 0.5 * box.width, box.y + 0.7 * box.height);
  await tab.mouse.down();
  await tab.mouse.move(box.x + 0.62 * box.width, box.y + 0.72 * box.height, { steps: 5 });
  const taken = await time();
  await until("it moves on while it is pulled", async () => (await time()) > taken + 0.2);
  await seen.shot("10-pulled");
  await tab.mouse.up();
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

/** A ridge by a pen that feels pressure. */
async function press({ tab }, force) {
  if ((await tab.getByRole("button", { name: "Both sides" }).getAttribute("aria-pressed")) === "true") await tab.getByRole("button", { name: "Both sides" }).click();
  await tab.locator("header").getByRole("button", { name: "Ridge", exact: true }).click();
  const box = await tab.locator("canvas").boundingBox(), hand = await tab.context().newCDPSession(tab);
  const act = (type, y) => hand.send("Input.dispatchMouseEvent", {
    type, x: box.x + 0.5 * box.width, y: box.y + y * box.height, button: "left", buttons: 1, clickCount: 1, pointerType: "pen", force });
  await act("mousePressed", 0.4);
  for (let y = 0.41; y < 0.6; y += 0.02) await act("mouseMoved", y);
  await act("mouseReleased", 0.6);
}

/** On a small sheet: pins by keys and clicks, the order of lines, both sides, keep and its verdict, a picture of it. */
async function sheet() {
  writeFileSync(join(scratch, "sheet.obj"), sheetText(14, 0.03));
  const seen = await open((await studio("sheet.obj", "--project", "sheet")).url, 1);
  const { tab } = seen;
  await tab.getByLabel(/border/).first().focus();
  await tab.keyboard.press("Space");  // all by keys: the whole border is held
  await seen.at(1);
  await tab.keyboard.press("Control+z");
  await seen.at(0);
  await tab.keyboard.press("p");
  const click = async (x, y) => {
    const box = await tab.locator("canvas").boundingBox();
    await tab.mouse.click(box.x + x * box.width, box.y + y * box.height);
  };
  await click(0.5, 0.5);
  await seen.at(1);
  await click(0.5, 0.3);
  await seen.at(2);
  const loop = await stroke(tab, [[0.42, 0.35], [0.58, 0.35], [0.58, 0.5], [0.42, 0.5]]);
  await seen.shot("14-lasso");
  await loop();
  await seen.at(3);
  assert.match(await tab.getByRole("button", { name: "Undo" }).getAttribute("title"), /hold what was encircled/);
  await tab.keyboard.press("Control+z");
  await seen.at(2);
  await tab.keyboard.press("Escape");
  await tab.keyboard.press("Control+z");
  await seen.at(1);
  await tab.getByLabel(/border/).first().check();
  await seen.at(2);
  await tab.keyboard.press("r");
  await tab.keyboard.press("m");
  assert.equal(await tab.getByRole("button", { name: "Both sides" }).getAttribute("aria-pressed"), "true");
  await tab.locator("header input[type=range]").first().fill("12");
  await (await stroke(tab, [[0.6, 0.35], [0.6, 0.65]]))();
  await seen.at(3);
  assert.equal(await seen.lines(), 2, "it is drawn on both sides");
  await seen.shot("11-both");
  await tab.keyboard.press("Escape");
  const names = () => tab.locator("aside .lines .name").allInnerTexts();
  const order = await names();
  await tab.keyboard.press("Alt+ArrowDown");
  await seen.at(4);
  assert.deepEqual(await names(), [order[1], order[0]]);
  await tab.locator("aside .name").nth(1).click();  // its sliders close, so that rows are rows
  const grip = await tab.locator(".grip").first().boundingBox(), last = await tab.locator("aside .lines > li").last().boundingBox();
  await tab.mouse.move(grip.x + 5, grip.y + 8);
  await tab.mouse.down();
  await tab.mouse.move(grip.x + 5, last.y + last.height - 4, { steps: 5 });
  await tab.mouse.up();
  await seen.at(5);
  assert.deepEqual(await names(), order, "dragged back into the first order");
  await accessible(seen, "lines");
  await press(seen, 0.25);
  await seen.at(6);
  assert.match(await tab.locator("aside .lines > li").last().innerText(), /\b6 mm/, "a pen that is pressed half as hard draws half as high");
  await tab.keyboard.press("Control+z");
  await seen.at(5);
  await tab.keyboard.press("Escape");
  await tab.keyboard.press("k");
  await seen.at(6);
  await until("the verdict", async () => (await tab.locator(".verdicts li").count()) === 2);
  await still(seen);
  await seen.shot("12-kept");
  const { colour } = await picture(seen), verdict = (await tab.locator(".verdicts .dot").first().getAttribute("class")).replace("dot ", "");
  const isOf = { held: ([r, g, b]) => g > r + 25 && g > b + 25, may_hold: ([r, g, b]) => b > g + 60 && r > g + 30,
    cannot_hold: ([r, g, b]) => r > g + 70 && r > b + 70 }[verdict];
  const sign = Array.from({ length: 40000 }, (_, i) => colour(((i % 200) + 0.5) / 200, 0.15 + 0.7 * ((Math.floor(i / 200) + 0.5) / 200))).filter(isOf);
  assert.ok(sign.length > 4 && sign.length < 400, `small signs say what became of the lines: ${verdict}, ${sign.length}`);
  assert.match(await tab.locator(".verdicts").innerText(), /held|cannot hold/);
  await tab.getByRole("button", { name: "Take back" }).click();
  await seen.at(5);
  await tab.keyboard.press("Control+y");
  await seen.at(6);
  await tab.getByRole("button", { name: "Accept" }).click();
  await until("it is accepted", async () => (await tab.locator(".verdicts").count()) === 0);
  await tab.keyboard.press("Control+z");
  await seen.at(5);
  assert.equal(await seen.lines(), 2);
  await tab.keyboard.press("t");
  await until("tangles are told", async () => /cross/.test(await seen.words()));
  await tab.getByRole("button", { name: "GLB", exact: true }).click();
  await until("it is given away", async () => /sheet\.glb/.test(await seen.words()));
  const download = tab.waitForEvent("download");
  await tab.getByRole("button", { name: "Picture" }).click();
  assert.equal((await download).suggestedFilename(), "sheet.png");
  await tab.keyboard.press("?");
  await accessible(seen, "help");
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** A ridge across all of a hanging sheet lasts at rest: nothing is lost, and no way back is offered. */
async function drapedAsDrawn() {
  writeFileSync(join(scratch, "hung.obj"), sheetText(14, 0.03));
  const seen = await open((await studio("hung.obj", "--project", "hung", "--pin-box=-1,0.41,-1,1,1,1")).url, 1);
  const { tab } = seen;
  await tab.keyboard.press("r");
  await (await stroke(tab, [[0.25, 0.5], [0.5, 0.5], [0.75, 0.5]]))();
  await seen.at(1);
  await tab.keyboard.press("Escape");
  await tab.keyboard.press("d");
  await seen.at(2);
  assert.doesNotMatch(await seen.words(), /lost/);
  assert.equal(await tab.getByRole("button", { name: "Undo and keep its lines" }).count(), 0);
  await seen.shot("17-draped-as-drawn");
  replay("hung");
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** A line across a hanging sheet becomes gathers; at rest it is drawn in, and what is saved has it. */
async function gathered() {
  const seen = await open((await studio("hung.obj", "--project", "gathered", "--pin-box=-1,0.41,-1,1,1,1")).url, 1);
  const { tab } = seen;
  await tab.keyboard.press("r");
  await (await stroke(tab, [[0.3, 0.62], [0.5, 0.62], [0.7, 0.62]]))();
  await seen.at(1);
  await tab.keyboard.press("Escape");
  await tab.getByRole("button", { name: "Gathers" }).click();
  await seen.at(2);
  assert.match(await tab.locator("aside .lines").innerText(), /gather 1[^]*80 %/);
  await tab.getByRole("slider", { name: "Drawn in to" }).fill("70");
  await seen.at(3);
  await accessible(seen, "gathers");
  await tab.keyboard.press("Control+s");
  await until("saved", async () => (await seen.words()).startsWith("Saved"));
  assert.deepEqual(strokesIn("gathered").map((s) => [s.height, s.gather]), [[0, 0.7]]);
  const before = await still(seen);
  await tab.keyboard.press("d");
  await seen.at(4);
  assert.notEqual(await seen.pixels(), before, "gathers are seen");
  assert.doesNotMatch(await seen.words(), /of its length, not/);
  await seen.shot("21-gathered");
  await touched(seen, 4);
  replay("gathered");
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** Cloth at rest is pinched by a click and pulled by a drag, each a step that is undone; a ring shows how far that reaches. */
async function touched(seen, step) {
  const { tab } = seen, place = await tab.locator("canvas").boundingBox();
  const at = (x, y) => [place.x + x * place.width, place.y + y * place.height];
  await tab.keyboard.press("i");
  await tab.getByLabel("What a touch does").selectOption("pinch");
  await tab.getByRole("slider", { name: "Radius of the touch" }).fill("60");
  await accessible(seen, "touch");
  await tab.mouse.move(...at(0.5, 0.5));
  await until("the ring", async () => (await tab.locator(".ring polygon").getAttribute("points"))?.length > 20);
  const before = await seen.pixels();
  await tab.mouse.click(...at(0.5, 0.5));
  await seen.at(step + 1);
  await seen.answered();
  assert.match(await seen.words(), /moved by up to [0-9.]+ mm/);
  await seen.shot("22-pinched");
  assert.notEqual(await seen.pixels(), before, "the pinch is seen");
  await tab.getByLabel("What a touch does").selectOption("pull");
  await tab.mouse.move(...at(0.6, 0.6));
  await tab.mouse.down();
  await tab.mouse.move(...at(0.62, 0.56), { steps: 4 });
  await tab.mouse.up();
  await seen.at(step + 2);
  await seen.answered();
  await tab.keyboard.press("Escape");
  await tab.keyboard.press("Control+z");
  await seen.at(step + 1);
  await seen.answered();
}

/** Where its scene says that the line learns nothing, it is draped flat, which is said; a button goes back and keeps it. */
async function drapedFlat() {
  writeFileSync(join(scratch, "ridge.json"),
    '{"strokes": [{"name": "ridge", "height": 0.01, "points": [[-0.15, 0.2, 0], [0.15, 0.2, 0]]}]}');
  writeFileSync(join(scratch, "flat.toml"),
    'garment.mesh = "hung.obj"\n[[lines]]\nstrokes = "ridge.json"\nrest = "flat"\n' +
    '[[pins]]\nbox = [-1, 0.41, -1, 1, 1, 1]\n');
  const seen = await open((await studio("flat.toml", "--project", "flat")).url, 1);
  const { tab } = seen;
  assert.equal(await seen.lines(), 1);
  const before = await seen.step();
  await tab.keyboard.press("d");
  await seen.at(before + 1);
  const instead = tab.getByRole("button", { name: "Undo and keep its lines" });
  await until("it offers to keep the line", async () => (await instead.count()) === 1);
  assert.match(await seen.words(), /lost/);
  await seen.shot("18-draped-flat");
  await instead.click();
  await until("the verdict in place of the drape", async () => (await tab.locator(".verdicts li").count()) === 1);
  assert.equal(await seen.step(), before + 1);
  assert.equal(await instead.count(), 0);
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** A skirt that was made for our figure, opened with a taller one: it lies about the first until it is draped. */
async function broughtToAnother() {
  const seen = await open((await studio()).url, 0);
  const { tab } = seen, dialog = tab.locator("dialog.open");
  await until("the gallery", async () => (await dialog.getByRole("button").count()) > 3);
  const made = spawnSync(furrow, ["body", "--height", "1.86", "-o", "tall.obj"], { cwd: scratch, encoding: "utf8" });
  assert.equal(made.status, 0, made.stderr);
  await dialog.getByLabel("Garment").setInputFiles(join(meshes, "skirt.obj"));
  assert.equal(await dialog.getByLabel("Made for").count(), 0, "it goes with a body");
  await dialog.getByLabel("Body").setInputFiles(join(scratch, "tall.obj"));
  await dialog.getByLabel("Made for").setInputFiles(join(meshes, "mannequin.obj"));
  await seen.shot("15-made-for");
  await dialog.getByRole("button", { name: "Open", exact: true }).click();
  const cloth = tab.getByRole("region", { name: "Cloth" });
  await until("the skirt that was made for another", async () => /made for/.test(await cloth.innerText()));
  assert.ok(await tab.getByRole("button", { name: "Keep" }).isDisabled());
  await still(seen);
  const before = await seen.pixels();
  await cloth.getByRole("button", { name: "Drape" }).click();
  await seen.at(1);
  assert.doesNotMatch(await cloth.innerText(), /made for/);
  await tab.waitForTimeout(600);
  assert.notEqual(await seen.pixels(), before, "another body is seen, and the skirt on it");
  await seen.shot("16-brought");
  const folder = await tab.locator("h1").innerText();
  assert.ok(existsSync(join(scratch, folder, "files", "mannequin.obj")));
  replay(folder);
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** Meshes of ours as figures of one GLB. */
function avatar(path, figures) {
  const all = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [] }], nodes: [], meshes: [], accessors: [], bufferViews: [] };
  const chunks = [];
  let length = 0;
  for (const [name, mesh] of Object.entries(figures)) {
    const made = spawnSync(furrow, ["smooth", join(meshes, mesh), "--iterations", "0", "-o", "one.glb", "--quiet"], { cwd: scratch });
    assert.equal(made.status, 0);
    const bytes = readFileSync(join(scratch, "one.glb")), text = bytes.readUInt32LE(12), binary = bytes.subarray(28 + text);
    const one = JSON.parse(bytes.toString("utf8", 20, 20 + text)), first = all.accessors.length, view = all.bufferViews.length;
    for (const v of one.bufferViews) all.bufferViews.push({ ...v, byteOffset: length + (v.byteOffset ?? 0) });
    for (const a of one.accessors) all.accessors.push({ ...a, bufferView: a.bufferView + view });
    const [{ attributes, indices }] = one.meshes[0].primitives;
    const moved = Object.fromEntries(Object.entries(attributes).map(([key, a]) => [key, a + first]));
    all.scenes[0].nodes.push(all.nodes.length);
    all.nodes.push({ name, mesh: all.meshes.length });
    all.meshes.push({ primitives: [{ attributes: moved, indices: indices + first }] });
    chunks.push(binary);
    length += binary.length;
  }
  all.buffers = [{ byteLength: length }];
  const words = JSON.stringify(all), text = Buffer.from(words + " ".repeat((4 - (Buffer.byteLength(words) % 4)) % 4)), head = Buffer.alloc(20), middle = Buffer.alloc(8);
  [0x46546c67, 2, 28 + text.length + length, text.length, 0x4e4f534a].forEach((word, i) => head.writeUInt32LE(word, 4 * i));
  [length, 0x004e4942].forEach((word, i) => middle.writeUInt32LE(word, 4 * i));
  writeFileSync(path, Buffer.concat([head, text, middle, ...chunks]));
}

/** Of a file with an avatar and its skirt each is chosen by its name; the drawing is played again from it. */
async function figuresOfOneFile() {
  const file = join(scratch, "avatar.glb");
  avatar(file, { Skirt: "skirt.obj", Body: "mannequin.obj" });
  const seen = await open((await studio()).url, 0);
  const { tab } = seen, dialog = tab.locator("dialog.open");
  await dialog.getByLabel("Garment", { exact: true }).setInputFiles(file);
  await dialog.getByLabel("Garment in it").selectOption("Skirt");
  await dialog.getByLabel("Body", { exact: true }).setInputFiles(file);
  await dialog.getByLabel("Body in it").selectOption("Body");
  await seen.shot("23-figures");
  await dialog.getByRole("button", { name: "Open", exact: true }).click();
  await until("the skirt", async () => (await tab.locator("h1").innerText()).startsWith("avatar"));
  await still(seen);
  await tab.keyboard.press("r");
  await (await stroke(tab, [[0.53, 0.4], [0.53, 0.7]]))();
  await seen.at(1);
  replay(await tab.locator("h1").innerText());
  assert.deepEqual(seen.faults, []);
  await tab.close();
}

/** A pocket lies on the sheet: its box is ticked, lets it go, and undo ticks it again. */
async function partFreed() {
  const corners = [[-0.05, 0.1], [0.05, 0.1], [0.05, 0.2], [-0.05, 0.2]].map(([x, y]) => `v ${x} ${y} 0.002\n`);
  writeFileSync(join(scratch, "pocket.obj"), `o sheet\n${sheetText(14, 0.03)}o pocket\n${corners.join("")}f -4 -3 -2 -1\n`);
  const { program, url } = await studio("pocket.obj", "--pin-loop", "top"), seen = await open(url, 1);
  const box = seen.tab.getByLabel("pocket", { exact: true });
  assert.ok(await box.isChecked());
  await box.click();
  await seen.at(1);
  assert.ok(!(await box.isChecked()));
  assert.equal(await seen.tab.getByLabel("sheet", { exact: true }).count(), 0, "what carries the others has no box");
  await seen.tab.keyboard.press("Control+z");
  await seen.at(0);
  assert.ok(await box.isChecked());
  await seen.shot("18-parts");
  await accessible(seen, "parts");
  assert.deepEqual(seen.faults, []);
  await seen.tab.close();
  await end(program);
}

await run(async () => {
  for (const name of ["skirt.obj", "mannequin.obj"]) copyFileSync(join(meshes, name), join(scratch, name));
  const first = await studio("skirt.obj", "--body", "mannequin.obj", "--pin-loop", "top");
  const seen = await open(first.url);
  await drawAndUndo(seen);
  await refuse(seen);
  await reachBordersAndChangeAll(seen);
  await dragLine(seen);
  await accessible(seen, "skirt");
  await fit(seen);
  await play(seen);
  assert.ok(!seen.tab.url().includes("token"), "the token leaves the address");
  const strokes = strokesIn("skirt-studio");
  assert.equal(strokes.length, 2);
  assert.ok(strokes[0].height > 0 && strokes[1].height < 0);
  assert.deepEqual(seen.faults, []);
  await end(first.program);
  await sheet();
  await partFreed();
  await figuresOfOneFile();
  await drapedAsDrawn();
  await gathered();
  await drapedFlat();
  await broughtToAnother();
});
