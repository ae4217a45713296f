// SPDX-License-Identifier: GPL-3.0-or-later
// What keys do (help.tsx lists them).
import { isIdle, isPen, type Page } from "./page";
import type { Studio } from "./studio";

type Keys = Record<string, () => void>;

function withControl(page: Page, studio: Studio, shift: boolean): Keys {
  const { chosen } = page.now();
  return {
    z: () => (shift ? studio.redo() : studio.undo()),
    y: () => studio.redo(),
    s: () => studio.save(),
    ...(chosen >= 0 && { d: () => void studio.lines.duplicate(chosen) }),
  };
}

function withAlt(page: Page, studio: Studio): Keys {
  const { chosen } = page.now(),
    move = (by: number) => void studio.lines.move(chosen, chosen + by);
  return chosen < 0 ? {} : { arrowup: () => move(-1), arrowdown: () => move(1) };
}

function plain(page: Page, studio: Studio): Keys {
  const { chosen, both, tool } = page.now(),
    { view, lines } = studio;
  return {
    r: () => studio.pick("ridge"),
    v: () => studio.pick("valley"),
    p: () => studio.pick("pin"),
    i: () => studio.pick("touch"),
    escape: () => studio.escape(),
    f: () => view.frameAll(),
    "1": () => view.look("front"),
    "2": () => view.look("back"),
    "3": () => view.look("right"),
    b: () => studio.toggle("body"),
    w: () => studio.toggle("wire"),
    c: () => studio.toggle("clay"),
    l: () => studio.toggle("lines"),
    d: () => void studio.drape(),
    k: () => void studio.keep(),
    t: () => void studio.showTangles(),
    " ": () => void studio.play(),
    "[": () => studio.resize(0.85),
    "]": () => studio.resize(1 / 0.85),
    "?": () => page.set({ help: true }),
    o: () => page.now().status && isIdle(page.now()) && page.set({ opening: "again" }),
    ...(isPen(tool)
      ? { m: () => page.set({ both: !both }) }
      : chosen >= 0 && { m: () => void lines.mirror(chosen) }),
    ...(chosen >= 0 && { delete: () => lines.remove(chosen) }),
  };
}

function onPicture({ view }: Studio): Keys {
  return {
    arrowleft: () => view.turn(-0.12, 0),
    arrowright: () => view.turn(0.12, 0),
    arrowup: () => view.turn(0, 0.12),
    arrowdown: () => view.turn(0, -0.12),
    "+": () => view.turn(0, 0, 1.15),
    "-": () => view.turn(0, 0, 1 / 1.15),
  };
}

/** Does what the key means where it was pressed, if it means something there. */
export function pressKey(e: KeyboardEvent, page: Page, studio: Studio) {
  const at = e.target as HTMLElement,
    key = e.key.toLowerCase();
  if (at.closest("dialog") || (at instanceof HTMLInputElement && at.type === "text")) return;
  let keys = plain(page, studio);
  if (e.ctrlKey || e.metaKey) keys = withControl(page, studio, e.shiftKey);
  else if (e.altKey) keys = withAlt(page, studio);
  else if (at instanceof HTMLSelectElement || (key === " " && at.closest("button, input")))
    return; // which take it themselves
  else if (at === studio.view.canvas) keys = { ...keys, ...onPicture(studio) };
  if (!keys[key]) return;
  e.preventDefault();
  keys[key]();
}
