// SPDX-License-Identifier: GPL-3.0-or-later
// What the cloth is made of, in words that people know; the program's own name is the tip.
import type { Status } from "./protocol";

/** By the program's names. The first eight have a swatch each, which app.css colours. */
const titles: Record<string, string> = {
  cotton: "Light cotton",
  silk: "Silk",
  wool: "Fine wool",
  denim: "Denim",
  jersey: "T-shirt jersey",
  "rib-knit": "Rib knit",
  "viscose-twill": "Viscose",
  "cotton-twill": "Cotton twill",
  interlock: "Interlock knit",
  "black-denim": "Black denim",
  "ivory-rib": "Rib knit, ivory",
  "camel-ponte": "Ponte knit",
  "gray-interlock": "Interlock knit, grey",
  "polyester-twill": "Polyester twill",
  "wool-twill": "Wool twill",
};
const swatches = Object.keys(titles).slice(0, 8);

export const titleOf = (name: string) =>
  titles[name] ?? name.replace(/-/g, " ").replace(/^./, (c) => c.toUpperCase());

interface Props {
  status: Status;
  choose(name: string): void;
}

export function Fabrics({ status, choose }: Props) {
  const { fabric, fabrics } = status;
  return (
    <>
      <div class="swatches" role="group" aria-label="Fabric">
        {fabrics
          .filter((f) => swatches.includes(f.name))
          .sort((a, b) => swatches.indexOf(a.name) - swatches.indexOf(b.name))
          .map((f) => (
            <button
              key={f.name}
              aria-pressed={f.name === fabric}
              title={`${f.words} (${f.name})`}
              onClick={() => f.name !== fabric && choose(f.name)}
            >
              <span class={`swatch ${f.name}`} aria-hidden="true" />
              {titleOf(f.name)}
            </button>
          ))}
      </div>
      <label>
        All fabrics
        <select value={fabric} onChange={(e) => choose(e.currentTarget.value)}>
          {fabrics.map((f) => (
            <option key={f.name} value={f.name}>
              {titleOf(f.name)}: {f.words}
            </option>
          ))}
        </select>
      </label>
    </>
  );
}
