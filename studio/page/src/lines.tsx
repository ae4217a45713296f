// SPDX-License-Identifier: GPL-3.0-or-later
// The list of lines, and the one that is being changed.
import { useRef, useState } from "preact/hooks";
import type { Line } from "./protocol";

export interface LineChange {
  name?: string;
  on?: boolean;
  height?: number;
  width?: number | null;
  sharpness?: number;
  press?: number;
  gather?: number | null;
  points?: number[][];
}
export interface LineActions {
  choose(line: number): void;
  /** The pointer is over it; null: over none. */
  point(line: number | null): void;
  /** Of a line, or of several. `live`: while a slider moves. */
  set(lines: number | number[], change: LineChange, live: boolean): void;
  remove(line: number): void;
  mirror(line: number): void;
  duplicate(line: number): void;
  move(line: number, to: number): void;
}

export const mm = (metres: number) => `${Math.round(metres * 1000)} mm`;
/** The width of a fold that names none, as the program chooses it. */
export const ownWidth = (height: number) => 5 * Math.abs(height);

/** How far a line that begins to be gathered is drawn in, and the height of one that is gathered no more. */
const usualGather = 0.8,
  usualHeight = 0.01;
const share = (of: number) => `${Math.round(100 * of)} %`;
/** The sharpness of a fold that names none, as rule fold draws it. */
const usualSharpness = 0;

interface SliderProps {
  label: string;
  short?: string; // what is seen of it
  value: number;
  min: number;
  max: number;
  step: number;
  text(value: number, dragged: boolean): string;
  change(value: number, live: boolean): void;
}
/** `text`: of a value, as it is said. While it is dragged it shows where it is, whatever the program sends. */
export function Slider({ label, short, value, min, max, step, text, change }: SliderProps) {
  const [dragged, setDragged] = useState<number | null>(null);
  const at = dragged ?? value,
    said = text(at, dragged !== null);
  return (
    <>
      <span aria-hidden="true">{short ?? label}</span>
      <input
        type="range"
        aria-label={label}
        aria-valuetext={said}
        {...{ min, max, step }}
        value={at}
        onInput={(e) => {
          setDragged(e.currentTarget.valueAsNumber);
          change(e.currentTarget.valueAsNumber, true);
        }}
        onChange={(e) => {
          setDragged(null);
          change(e.currentTarget.valueAsNumber, false);
        }}
      />
      <output class="much">{said}</output>
    </>
  );
}

function Edit({
  line,
  index,
  count,
  actions,
}: {
  line: Line;
  index: number;
  count: number;
  actions: LineActions;
}) {
  const height = line.height ?? 0.01,
    sign = height < 0 ? -1 : 1;
  const set = (change: LineChange, live = false) => actions.set(index, change, live);
  const gathers = line.gather !== undefined;
  const raise = (side: number) =>
    set({ height: side * (Math.abs(height) || usualHeight), ...(gathers && { gather: null }) });
  return (
    <div class="edit">
      <label for={`name-${index}`}>Name</label>
      <input
        id={`name-${index}`}
        type="text"
        value={line.name}
        maxLength={100}
        onChange={(e) => set({ name: e.currentTarget.value })}
      />
      <span>Kind</span>
      <span class="wide" role="group" aria-label="Kind">
        <button class="small" aria-pressed={!gathers && sign > 0} onClick={() => raise(1)}>
          Ridge
        </button>
        <button class="small" aria-pressed={!gathers && sign < 0} onClick={() => raise(-1)}>
          Valley
        </button>
        <button
          class="small"
          title="A thread draws the line in as the cloth comes to rest"
          aria-pressed={gathers}
          onClick={() => !gathers && set({ gather: usualGather, height: 0, width: null })}
        >
          Gathers
        </button>
      </span>
      {gathers ? (
        <Slider
          label="Drawn in to"
          value={100 * line.gather!}
          min={30}
          max={100}
          step={1}
          text={(v) => share(v / 100)}
          change={(v, live) => !live && set({ gather: v / 100 })}
        />
      ) : (
        <Slider
          label="Height"
          value={Math.abs(height) * 1000}
          min={0}
          max={Math.max(100, Math.abs(height) * 1000)}
          step={1}
          text={(v, dragged) => (line.varies && !dragged ? "varies" : mm(v / 1000))}
          change={(v, live) => set({ height: (sign * v) / 1000 }, live)}
        />
      )}
      <Slider
        label="Width"
        value={(line.width ?? (gathers ? 0.04 : ownWidth(height))) * 1000}
        min={5}
        max={Math.max(300, (line.width ?? 0) * 1000)}
        step={1}
        text={(v, dragged) => (line.width === undefined && !dragged ? "auto" : mm(v / 1000))}
        change={(v, live) => set({ width: v / 1000 }, live)}
      />
      {line.width !== undefined && (
        <span class="wide">
          <button class="small" onClick={() => set({ width: null })}>
            Width by itself
          </button>
        </span>
      )}
      <Slider
        label="Sharpness"
        value={line.sharpness ?? usualSharpness}
        min={0}
        max={1}
        step={0.05}
        text={(v) => v.toFixed(2)}
        change={(v, live) => set({ sharpness: v }, live)}
      />
      <Slider
        label="Press"
        value={Math.log10(line.press ?? 1)}
        min={0}
        max={2}
        step={0.1}
        text={(v) => `× ${(10 ** v).toFixed(10 ** v < 10 ? 1 : 0)}`}
        change={(v, live) => !live && set({ press: Number((10 ** v).toPrecision(3)) })}
      />
      <span class="wide">
        <button
          class="small"
          title="Draw it on the other side, too (M)"
          onClick={() => actions.mirror(index)}
        >
          Mirror
        </button>
        <button class="small" title="Once more, beside it (Ctrl D)" onClick={() => actions.duplicate(index)}>
          Duplicate
        </button>
        <button
          class="small"
          aria-label="Move up"
          title="Earlier in the order (Alt ↑)"
          disabled={index === 0}
          onClick={() => actions.move(index, index - 1)}
        >
          ↑
        </button>
        <button
          class="small"
          aria-label="Move down"
          title="Later in the order (Alt ↓)"
          disabled={index === count - 1}
          onClick={() => actions.move(index, index + 1)}
        >
          ↓
        </button>
      </span>
    </div>
  );
}

/** Of all lines at once: each keeps its place, and stays a ridge or a valley. */
function EditAll({ lines, actions }: { lines: Line[]; actions: LineActions }) {
  const all = lines.map((_, i) => i),
    first = lines[0];
  const differ = (value: (line: Line) => unknown) =>
    lines.some((line) => line.varies || value(line) !== value(first));
  const size = (line: Line) => Math.abs(line.height ?? 0.01),
    width = (line: Line) => line.width ?? ownWidth(size(line));
  const sharpness = (line: Line) => line.sharpness ?? usualSharpness;
  const or = (isOne: boolean, dragged: boolean, text: string) => (isOne || dragged ? text : "differ");
  return (
    <div class="edit all" role="group" aria-label="All lines">
      <Slider
        label="Height"
        value={size(first) * 1000}
        min={1}
        max={Math.max(100, size(first) * 1000)}
        step={1}
        text={(v, d) => or(!differ(size), d, mm(v / 1000))}
        change={(v, live) => actions.set(all, { height: v / 1000 }, live)}
      />
      <Slider
        label="Width"
        value={width(first) * 1000}
        min={5}
        max={Math.max(300, width(first) * 1000)}
        step={1}
        text={(v, d) =>
          lines.every((l) => l.width === undefined) && !d ? "auto" : or(!differ(width), d, mm(v / 1000))
        }
        change={(v, live) => actions.set(all, { width: v / 1000 }, live)}
      />
      <Slider
        label="Sharpness"
        value={sharpness(first)}
        min={0}
        max={1}
        step={0.05}
        text={(v, d) => or(!differ(sharpness), d, v.toFixed(2))}
        change={(v, live) => actions.set(all, { sharpness: v }, live)}
      />
    </div>
  );
}

export function Lines({
  lines,
  again,
  chosen,
  actions,
}: {
  lines: Line[];
  again: boolean;
  chosen: number;
  actions: LineActions;
}) {
  const list = useRef<HTMLUListElement>(null);
  const [held, setHeld] = useState(-1); // the line that is dragged to another place
  const [over, setOver] = useState(-1);
  const [all, setAll] = useState(false);
  const begin = (e: PointerEvent, i: number) => {
    (e.currentTarget as HTMLElement).setPointerCapture(e.pointerId);
    setHeld(i);
    setOver(i);
  };
  const move = (e: PointerEvent) => {
    if (held < 0) return;
    const rows = [...list.current!.children].map((row) => row.getBoundingClientRect());
    const above = rows.filter(
      (row, i) => i !== held && e.clientY > row.top + Math.min(row.height, 40) / 2,
    ).length;
    setOver(above);
  };
  const drop = () => {
    if (held >= 0 && over >= 0 && over !== held) actions.move(held, over);
    setHeld(-1);
    setOver(-1);
  };
  if (lines.length === 0)
    return (
      <p class="note">{again ? "No line since then." : "No line yet."} Pick a pen and draw on the cloth.</p>
    );
  return (
    <>
      {lines.length > 1 && (
        <button class="small" aria-expanded={all} onClick={() => setAll(!all)}>
          All {lines.length} lines
        </button>
      )}
      {lines.length > 1 && all && <EditAll lines={lines} actions={actions} />}
      <ul class="lines" ref={list}>
        {lines.map((line, i) => (
          <li
            key={i}
            onPointerEnter={() => actions.point(i)}
            onPointerLeave={() => actions.point(null)}
            class={[
              i === chosen ? "chosen" : "",
              i === held ? "held" : "",
              i === over && over !== held ? (over > held ? "below" : "above") : "",
            ].join(" ")}
          >
            <div class={line.on ? "row" : "row off"}>
              {lines.length > 1 && (
                <span
                  class="grip"
                  aria-hidden="true"
                  title="Drag to change the order"
                  onPointerDown={(e) => begin(e, i)}
                  onPointerMove={move}
                  onPointerUp={drop}
                  onPointerCancel={() => setHeld(-1)}
                >
                  ⠿
                </span>
              )}
              <input
                type="checkbox"
                checked={line.on}
                aria-label={`${line.name}: on`}
                onChange={(e) => actions.set(i, { on: e.currentTarget.checked }, false)}
              />
              <span class={(line.height ?? 1) < 0 ? "dot valley" : "dot"} aria-hidden="true" />
              <button
                class="name"
                aria-expanded={i === chosen}
                onClick={() => actions.choose(i === chosen ? -1 : i)}
              >
                {line.name}
              </button>
              <span class="much">
                {line.gather
                  ? share(line.gather)
                  : line.varies
                    ? "varies"
                    : mm(Math.abs(line.height ?? 0.01))}
              </span>
              <button
                class="small"
                aria-label={`Delete ${line.name}`}
                title="Delete"
                onClick={() => actions.remove(i)}
              >
                ✕
              </button>
            </div>
            {i === chosen && <Edit key={i} line={line} index={i} count={lines.length} actions={actions} />}
          </li>
        ))}
      </ul>
    </>
  );
}
