// SPDX-License-Identifier: GPL-3.0-or-later
// Above the picture: pens, the next line's size, undo and files.
import { mm, ownWidth, Slider } from "./lines";
import { type Feel, isIdle, type Page } from "./page";
import type { Studio } from "./studio";
import type { TouchKind } from "./touch";

const tools = [
  ["look", "Look", "Esc"],
  ["ridge", "Ridge", "R"],
  ["valley", "Valley", "V"],
  ["pin", "Pin", "P"],
  ["touch", "Touch", "I"],
] as const;

/** How the next line will be drawn. */
function Draft({ page }: { page: Page }) {
  const { draft, both, feels } = page.now(),
    set = (change: Partial<typeof draft>) => page.set({ draft: { ...page.now().draft, ...change } });
  return (
    <>
      <div class="group">
        <Slider
          label="New height"
          short="Height"
          value={draft.height * 1000}
          min={2}
          max={100}
          step={1}
          text={(v) => mm(v / 1000)}
          change={(v) => set({ height: v / 1000 })}
        />
      </div>
      <div class="group">
        <Slider
          label="New width"
          short="Width"
          value={(draft.width ?? ownWidth(draft.height)) * 1000}
          min={10}
          max={300}
          step={5}
          text={(v, dragged) => (draft.width === null && !dragged ? "auto" : mm(v / 1000))}
          change={(v) => set({ width: v / 1000 })}
        />
        {draft.width !== null && (
          <button class="small" onClick={() => set({ width: null })}>
            auto
          </button>
        )}
      </div>
      {feels && (
        <div class="group">
          <select
            aria-label="How the height follows the pen's pressure"
            title="How the height follows the pen's pressure"
            value={draft.feel}
            onChange={(e) => set({ feel: e.currentTarget.value as Feel })}
          >
            <option value="even">Pressure</option>
            <option value="soft">Soft</option>
            <option value="firm">Firm</option>
            <option value="none">Not felt</option>
          </select>
        </div>
      )}
      <div class="group">
        <button
          aria-pressed={both}
          title="Draw each line on the other side, too (M while a pen is up)"
          onClick={() => page.set({ both: !both })}
        >
          Both sides
        </button>
      </div>
    </>
  );
}

const touches: [TouchKind, string][] = [
  ["iron", "Iron"],
  ["steam", "Steam"],
  ["pinch", "Pinch"],
  ["pull", "Pull"],
];

/** What the next touch will do. */
function NextTouch({ page }: { page: Page }) {
  const { touch } = page.now(),
    set = (change: Partial<typeof touch>) => page.set({ touch: { ...page.now().touch, ...change } }),
    pinches = touch.kind === "pinch";
  return (
    <>
      <div class="group">
        <select
          aria-label="What a touch does"
          value={touch.kind}
          onChange={(e) => set({ kind: e.currentTarget.value as TouchKind })}
        >
          {touches.map(([kind, label]) => (
            <option key={kind} value={kind}>
              {label}
            </option>
          ))}
        </select>
      </div>
      <div class="group">
        <Slider
          label="Radius of the touch"
          short="Radius"
          value={touch.radius * 1000}
          min={20}
          max={400}
          step={5}
          text={(v) => mm(v / 1000)}
          change={(v) => set({ radius: v / 1000 })}
        />
      </div>
      <div class="group">
        <Slider
          label="Strength of the touch"
          short="Strength"
          value={100 * (pinches ? touch.pinch : touch.strength)}
          min={5}
          max={pinches ? 80 : 100}
          step={5}
          text={(v) => `${Math.round(v)} %`}
          change={(v) => set(pinches ? { pinch: v / 100 } : { strength: v / 100 })}
        />
      </div>
    </>
  );
}

export function Toolbar({ page, studio }: { page: Page; studio?: Studio }) {
  const state = page.now(),
    { status, tool } = state;
  return (
    <header>
      <h1 title={status?.title}>{status?.title ?? "Furrow studio"}</h1>
      <div class="group" role="group" aria-label="Pen">
        {tools.map(([t, label, key]) => (
          <button
            key={t}
            aria-pressed={tool === t}
            title={`${label} (${key})`}
            onClick={() => studio?.pick(t)}
          >
            {label}
          </button>
        ))}
      </div>
      {tool === "touch" ? <NextTouch page={page} /> : <Draft page={page} />}
      <div class="group">
        <button
          disabled={!status?.undo}
          title={status?.undo ? `Undo: ${status.undo} (Ctrl Z)` : "Nothing to undo"}
          onClick={() => studio?.undo()}
        >
          Undo
        </button>
        <button
          disabled={!status?.redo}
          title={status?.redo ? `Do again: ${status.redo} (Ctrl Y)` : "Nothing to do again"}
          onClick={() => studio?.redo()}
        >
          Redo
        </button>
        <button title="Save (Ctrl S)" disabled={!status} onClick={() => studio?.save()}>
          Save
        </button>
        <button
          title="Another garment (O)"
          disabled={!isIdle(state)}
          onClick={() => page.set({ opening: "again" })}
        >
          Open
        </button>
        <button title="Keys (?)" aria-label="Help" onClick={() => page.set({ help: true })}>
          ?
        </button>
      </div>
    </header>
  );
}
