// SPDX-License-Identifier: GPL-3.0-or-later
// Over the picture: a hint, the mirror's place, and buttons for what is seen.
import { mm, Slider } from "./lines";
import { isIdle, type Page, type State } from "./page";
import type { Status } from "./protocol";
import type { Studio } from "./studio";

/** What a first start is told, one thing after the other. */
const hints: [(s: Status) => boolean, string][] = [
  [
    (s) => s.lines.length === 0 && s.step === 0,
    "Pick Ridge or Valley above, then draw on the cloth. Drag to turn it.",
  ],
  [
    (s) => s.step === 1 && s.lines.length > 0,
    "Its height, width and sharpness are on the right; choose it, and drag it by its dots. Draw more.",
  ],
  [
    (s) => s.step <= 12 && s.lines.some((l) => l.on) && s.can_drape,
    "When all lines are drawn: Drape (D) lets the cloth come to rest and holds them. " +
      "Undo takes anything back.",
  ],
  [(s) => s.undo === "keep" && s.step <= 13, "Now press Drape (D): the cloth comes to rest with its folds."],
  [
    (s) => s.undo === "drape" && s.step <= 14,
    "Picture, below on the right, takes one. Draw more, or Play (Space); ? shows all keys.",
  ],
];

function hintFor({ status, opening, tool }: State) {
  if (!status) return opening ? "" : "Opening …";
  if (tool === "pin")
    return (
      "Click the cloth to hold it there, or to let it go; Shift: the whole border. " +
      "Draw a loop to hold all within; Shift: to let it go. Esc: enough."
    );
  if (tool === "touch")
    return (
      "Click the cloth where it rests: it is ironed, steamed or pinched there; to pull it, drag. " +
      "[ and ]: how far it reaches. Esc: enough."
    );
  if (tool !== "look")
    return (
      "Draw on the cloth; begin and end beside it to reach its border. Drag on the background to turn it. " +
      "Shift: straight. Esc: lay the pen down."
    );
  return hints.find(([fits]) => fits(status))?.[1] ?? "";
}

/** Where the plane is that lines are mirrored at. */
function Middle({ page, studio, status }: { page: Page; studio?: Studio; status: Status }) {
  const at = status.middle * 1000;
  const change = (v: number, isLive: boolean) => {
    page.set({ middle: isLive ? v / 1000 : null });
    if (!isLive) void studio?.ask("middle", { x: v / 1000 });
  };
  return (
    <div class="middle group">
      <Slider
        label="Middle"
        value={at}
        min={Math.round(at) - 300}
        max={Math.round(at) + 300}
        step={1}
        text={(v) => mm(v / 1000)}
        change={change}
      />
    </div>
  );
}

function Views({ page, studio }: { page: Page; studio?: Studio }) {
  const state = page.now(),
    { status, seen, tangles } = state,
    view = studio?.view;
  return (
    <div class="views" role="group" aria-label="View">
      <button class="small" title="The cloth; once more: with its body (F)" onClick={() => view?.frameAll()}>
        Frame
      </button>
      <button class="small" title="Front (1)" onClick={() => view?.look("front")}>
        Front
      </button>
      <button class="small" title="Back (2)" onClick={() => view?.look("back")}>
        Back
      </button>
      <button class="small" title="Side (3)" onClick={() => view?.look("right")}>
        Side
      </button>
      {status?.has_body && (
        <button
          class="small"
          aria-pressed={seen.body}
          title="Body (B)"
          onClick={() => studio?.toggle("body")}
        >
          Body
        </button>
      )}
      <button
        class="small"
        aria-pressed={seen.lines}
        title="Lines: seen once more; each is seen while it is drawn, chosen or pointed at (L)"
        onClick={() => studio?.toggle("lines")}
      >
        Lines
      </button>
      <button
        class="small"
        aria-pressed={tangles}
        disabled={!isIdle(state)}
        title="Where cloth crosses cloth (T)"
        onClick={() => void studio?.showTangles()}
      >
        Tangles
      </button>
      <button
        class="small"
        aria-pressed={seen.clay}
        title="The shape alone, as of clay (C)"
        onClick={() => studio?.toggle("clay")}
      >
        Clay
      </button>
      <button
        class="small"
        aria-pressed={seen.wire}
        title="Wireframe (W)"
        onClick={() => studio?.toggle("wire")}
      >
        Wire
      </button>
    </div>
  );
}

export function OverPicture({ page, studio }: { page: Page; studio?: Studio }) {
  const state = page.now(),
    hint = hintFor(state);
  return (
    <>
      {hint && (
        <div class="hint" role="status">
          {hint}
        </div>
      )}
      {state.both && state.status && <Middle page={page} studio={studio} status={state.status} />}
      <Views page={page} studio={studio} />
    </>
  );
}
