// SPDX-License-Identifier: GPL-3.0-or-later
// The list of lines, and the one that is being changed.
import type { Line } from "./protocol";

export interface LineActions {
  choose(line: number): void;
  /** `live`: while a slider moves. */
  set(line: number, change: object, live: boolean): void;
  remove(line: number): void;
  mirror(line: number): void;
}

export const mm = (metres: number) => `${Math.round(metres * 1000)} mm`;
/** The width of a fold that names none, as the program chooses it. */
export const ownWidth = (height: number) => 5 * Math.abs(height);

interface SliderProps { label: string; value: number; min: number; max: number; step: number; text: string; change(value: number, live: boolean): void }
export function Slider({ label, value, min, max, step, text, change }: SliderProps) {
  return (
    <>
      <span aria-hidden="true">{label}</span>
      <input type="range" aria-label={label} aria-valuetext={text} {...{ min, max, step, value }}
        onInput={(e) => change(e.currentTarget.valueAsNumber, true)} onChange={(e) => change(e.currentTarget.valueAsNumber, false)} />
      <output class="much">{text}</output>
    </>
  );
}

function Edit({ line, index, actions }: { line: Line; index: number; actions: LineActions }) {
  const height = line.height ?? 0.01, sign = height < 0 ? -1 : 1;
  const set = (change: object, live = false) => actions.set(index, change, live);
  return (
    <div class="edit">
      <label for={`name-${index}`}>Name</label>
      <input id={`name-${index}`} type="text" value={line.name} maxLength={100} onChange={(e) => set({ name: e.currentTarget.value })} />
      <span>Kind</span>
      <span class="wide" role="group" aria-label="Kind">
        <button class="small" aria-pressed={sign > 0} onClick={() => set({ height: Math.abs(height) })}>Ridge</button>
        <button class="small" aria-pressed={sign < 0} onClick={() => set({ height: -Math.abs(height) })}>Valley</button>
      </span>
      <Slider label="Height" value={Math.abs(height) * 1000} min={0} max={Math.max(100, Math.abs(height) * 1000)} step={1}
        text={line.varies ? "varies" : mm(Math.abs(height))} change={(v, live) => set({ height: (sign * v) / 1000 }, live)} />
      <Slider label="Width" value={(line.width ?? ownWidth(height)) * 1000} min={5} max={Math.max(300, (line.width ?? 0) * 1000)} step={1}
        text={line.width === undefined ? "auto" : mm(line.width)} change={(v, live) => set({ width: v / 1000 }, live)} />
      {line.width !== undefined && <span class="wide"><button class="small" onClick={() => set({ width: null })}>Width by itself</button></span>}
      <Slider label="Sharpness" value={line.sharpness ?? 0} min={0} max={1} step={0.05} text={(line.sharpness ?? 0).toFixed(2)}
        change={(v, live) => set({ sharpness: v }, live)} />
      <span class="wide"><button class="small" title="Draw it on the other side, too (M)" onClick={() => actions.mirror(index)}>Mirror</button></span>
    </div>
  );
}

export function Lines({ lines, again, chosen, actions }: { lines: Line[]; again: boolean; chosen: number; actions: LineActions }) {
  if (lines.length === 0) return <p class="note">{again ? "No line since then." : "No line yet."} Pick a pen and draw on the cloth.</p>;
  return (
    <ul class="lines">
      {lines.map((line, i) => (
        <li key={i} class={i === chosen ? "chosen" : ""}>
          <div class={line.on ? "row" : "row off"}>
            <input type="checkbox" checked={line.on} aria-label={`${line.name}: on`} onChange={(e) => actions.set(i, { on: e.currentTarget.checked }, false)} />
            <span class={(line.height ?? 1) < 0 ? "dot valley" : "dot"} aria-hidden="true" />
            <button class="name" aria-expanded={i === chosen} onClick={() => actions.choose(i === chosen ? -1 : i)}>{line.name}</button>
            <span class="much">{line.varies ? "varies" : mm(Math.abs(line.height ?? 0.01))}</span>
            <button class="small" aria-label={`Delete ${line.name}`} title="Delete" onClick={() => actions.remove(i)}>✕</button>
          </div>
          {i === chosen && <Edit line={line} index={i} actions={actions} />}
        </li>
      ))}
    </ul>
  );
}
