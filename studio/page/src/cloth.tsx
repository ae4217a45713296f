// SPDX-License-Identifier: GPL-3.0-or-later
// The cloth: what it is made of, what holds it, and what it is asked to do.
import { Fabrics } from "./fabrics";
import { Slider } from "./lines";
import type { Border, Done, Status, Vector } from "./protocol";

/** What colours of the cloth can show. */
export type ClothMap = "strain" | "distance" | "mass";
export interface ClothActions {
  fabric(name: string): void;
  hold(border: number, on: boolean): void;
  /** A part goes with the cloth that it lies on, or by itself. */
  attach(part: number, on: boolean): void;
  wind(velocity: Vector): void;
  drape(): void;
  keep(): void;
  play(seconds?: number): void;
  map(of: ClothMap): void;
  /** `drapes`: and lets the cloth come to rest. */
  accept(drapes: boolean): void;
  takeBack(): void;
  /** How fast a play is seen, over the clock's pace. */
  pace(speed: number): void;
}

interface Props {
  status: Status;
  busy: string;
  mayDraw: boolean;
  map: string;
  moving: number;
  speed: number;
  kept?: Done;
  actions: ClothActions;
}

/** Borders that are told apart in a list; more of them are pinned by clicks. */
const mostBorders = 6;
const placeOf = (border: Border, isOnly: boolean) => {
  if (isOnly) return "Whole";
  if (border.name === "top") return "Upper";
  return border.name === "bottom" ? "Lower" : `${Number(border.name) + 1}.`;
};
const nameOf = (border: Border, isOnly: boolean) =>
  `${placeOf(border, isOnly)} border, ${Math.round(border.length * 100)} cm`;

function Borders({ status, actions }: { status: Status; actions: ClothActions }) {
  if (status.borders.length === 0) return null;
  return (
    <fieldset>
      <legend>Held</legend>
      {status.borders.slice(0, mostBorders).map((border, i) => (
        <label class="check" key={i}>
          <input
            type="checkbox"
            checked={border.held}
            onChange={(e) => actions.hold(i, e.currentTarget.checked)}
          />
          {nameOf(border, status.borders.length === 1)}
        </label>
      ))}
    </fieldset>
  );
}

function Parts({ status, actions }: { status: Status; actions: ClothActions }) {
  if (status.parts.length === 0) return null;
  return (
    <fieldset>
      <legend title="Buttons, pockets, belts: they keep their place on the cloth; what is not ticked moves by itself">
        Goes with the cloth
      </legend>
      {status.parts.map((part, i) => (
        <label class="check" key={i}>
          <input
            type="checkbox"
            checked={part.goes}
            onChange={(e) => actions.attach(i, e.currentTarget.checked)}
          />
          {part.name}
        </label>
      ))}
    </fieldset>
  );
}

/** Where the air goes, as seen from above: 0 to the front, 90 to the right of the picture. */
function Wind({ wind, blow }: { wind: Vector; blow(velocity: Vector): void }) {
  const speed = Math.hypot(wind[0], wind[2]),
    way = speed > 0 ? (Math.round((Math.atan2(wind[0], wind[2]) * 180) / Math.PI) + 360) % 360 : 90;
  const change = (speed: number, way: number) => {
    const a = (way * Math.PI) / 180;
    blow([Number((speed * Math.sin(a)).toFixed(4)), wind[1], Number((speed * Math.cos(a)).toFixed(4))]);
  };
  return (
    <div class="edit wind" role="group" aria-label="Wind">
      <Slider
        label="Wind"
        value={speed}
        min={0}
        max={10}
        step={0.5}
        text={(v) => (v === 0 ? "calm" : `${v.toFixed(1)} m/s`)}
        change={(v, live) => !live && change(v, way)}
      />
      {speed > 0 && (
        <Slider
          label="Towards"
          value={way}
          min={0}
          max={355}
          step={5}
          text={(v) => `${v}°`}
          change={(v, live) => !live && change(speed, v)}
        />
      )}
    </div>
  );
}

function Verdicts({ kept, actions }: { kept: Done; actions: ClothActions }) {
  return (
    <section class="verdicts" aria-label="Verdict">
      <h3>{kept.all_hold ? "Every line holds" : "Not every line is sure to hold"}</h3>
      <ul>
        {kept.verdicts!.map((v, i) => (
          <li key={i}>
            <span class={`dot ${v.verdict}`} aria-hidden="true" />
            <span>
              <b>{v.name}</b>: {v.words}
            </span>
          </li>
        ))}
      </ul>
      <p class="note">
        {kept.legend} Press: as if ironed or starched there. Struts: threads that lace the fold.
      </p>
      <div class="group">
        <button class="main" onClick={() => actions.accept(true)}>
          Drape it
        </button>
        <button title="Go on with it as it is: draw more" onClick={() => actions.accept(false)}>
          Accept
        </button>
        <button onClick={actions.takeBack}>Take back</button>
      </div>
    </section>
  );
}

export function Cloth({ status, busy, mayDraw, map, moving, speed, kept, actions }: Props) {
  const idle = busy === "" && mayDraw,
    held = status.can_drape,
    brought = !status.made_for_another;
  return (
    <section class="cloth" aria-label="Cloth">
      <h2>Cloth</h2>
      <div class="group wrap">
        <button
          disabled={!held || !brought || !idle}
          title="Try each line in gusts, and tell whether it will hold (K)"
          onClick={actions.keep}
        >
          Keep
        </button>
        <button
          class={kept ? "" : "main"}
          disabled={!held || !idle}
          title="Let it come to rest, its lines held (D)"
          onClick={actions.drape}
        >
          Drape
        </button>
        <button
          disabled={!held || !brought || !mayDraw || (busy !== "" && busy !== "play")}
          title="Play, pause (Space)"
          onClick={() => actions.play()}
        >
          {busy === "play" ? "Pause" : "Play"}
        </button>
        <button
          disabled={!held || !brought || !idle}
          title="One step of 1/60 s"
          onClick={() => actions.play(1 / 60)}
        >
          Step
        </button>
        <select
          aria-label="Speed"
          title="How fast it is seen to move, at most"
          disabled={busy === "play"}
          value={speed}
          onChange={(e) => actions.pace(Number(e.currentTarget.value))}
        >
          {[1, 0.5, 0.25, 0.1].map((s) => (
            <option key={s} value={s}>
              {s}×
            </option>
          ))}
        </select>
      </div>
      {held && status.has_body && status.borders.some((b) => b.name === "top" && !b.held) && (
        <p class="note">
          Nothing holds the upper border: a skirt or trousers slip down, and folds at the waist open.{" "}
          <button
            class="small"
            disabled={!idle}
            onClick={() =>
              actions.hold(
                status.borders.findIndex((b) => b.name === "top"),
                true,
              )
            }
          >
            Hold it
          </button>
        </p>
      )}
      {kept && <Verdicts kept={kept} actions={actions} />}
      {(busy === "play" || status.time > 0) && (
        <p class="note" data-time={moving}>
          At {(busy === "play" ? moving : status.time).toFixed(2)} s of its motion.
          {busy === "play" && " Pull it with the pointer."}
        </p>
      )}
      <Fabrics status={status} choose={actions.fabric} />
      <Borders status={status} actions={actions} />
      <Parts status={status} actions={actions} />
      <Wind wind={status.wind} blow={actions.wind} />
      <div class="group" role="group" aria-label="Colours">
        <span>Show</span>
        {(
          [
            ["strain", "Strain"],
            ["distance", "Distance"],
            ["mass", "Mass"],
          ] as const
        )
          .filter(([of]) => of === "mass" || (status.has_body && brought))
          .map(([of, name]) => (
            <button key={of} aria-pressed={map === of} disabled={!idle} onClick={() => actions.map(of)}>
              {name}
            </button>
          ))}
      </div>
      <p class="note">
        {!brought
          ? "It lies about the body that it was made for. Drape brings it to yours, in its own size, and lets it come " +
            "to rest there."
          : held
            ? "Drape lets the cloth come to rest and holds its lines. Keep tries each in gusts, too, for half a minute or so. " +
              "Play lets it move."
            : "To let it move, hold a border, pin it (P), or open it with a body (O)."}
      </p>
    </section>
  );
}
