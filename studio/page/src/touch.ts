// SPDX-License-Identifier: GPL-3.0-or-later
// The hand on cloth that rests: a click irons, steams or pinches it, a drag pulls it.
import type { Vector3 } from "three";
import type { Hit } from "./picker";
import type { Ring } from "./ring";
import type { View } from "./view";

export type TouchKind = "iron" | "steam" | "pinch" | "pull";
export interface TouchSettings {
  on: boolean;
  kind: TouchKind;
  radius: number; // [m]
}

/** A drag that pulls by less is none [pixels]. */
const shortest = 8;

export class Touch {
  private from: { hit: Hit; x: number; y: number } | null = null;
  private to: Vector3 | null = null;
  private last?: [number, number];

  /** `touched`: `by`: the way of a pull [m]. */
  constructor(
    private view: View,
    private ring: Ring,
    private settings: () => TouchSettings,
    private touched: (at: Vector3, by: Vector3 | null) => void,
  ) {
    const canvas = view.canvas;
    canvas.addEventListener("pointerleave", () => (this.last = undefined));
    canvas.addEventListener("pointerdown", (e) => this.begin(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
    canvas.addEventListener("pointerup", (e) => this.end(e), { capture: true });
    canvas.addEventListener("pointercancel", () => this.drop(), { capture: true });
  }

  get pulling() {
    return this.to !== null;
  }

  private begin(e: PointerEvent) {
    if (!this.settings().on || e.button !== 0) return;
    const hit = this.view.picker.pick(e.clientX, e.clientY);
    if (!hit) return; // beside the cloth the camera turns
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    this.from = { hit, x: e.clientX, y: e.clientY };
  }

  /** Shows how far it reaches, where the pointer is; `says`: and how far that is. */
  follow(says = false) {
    const { on, radius } = this.settings();
    if (!on) return;
    const hit = this.last ? this.view.picker.pick(...this.last) : null;
    if (hit) this.ring.show(hit, 2 * radius, says ? `${Math.round(1000 * radius)} mm` : "", false);
    else this.ring.hide();
  }

  private move(e: PointerEvent) {
    this.last = [e.clientX, e.clientY];
    if (!this.from) return e.buttons === 0 ? this.follow() : undefined;
    e.stopImmediatePropagation();
    if (this.settings().kind !== "pull") return;
    this.to = this.view.picker.dragTo(e.clientX, e.clientY, this.from.hit.shown);
    if (this.to) this.view.showRope([this.from.hit.shown, this.to]);
  }

  private end(e: PointerEvent) {
    const { from, to } = this;
    if (!from) return;
    this.drop();
    const pulls = this.settings().kind === "pull";
    if (!pulls) return this.touched(from.hit.shown, null);
    if (to && Math.hypot(e.clientX - from.x, e.clientY - from.y) >= shortest)
      this.touched(from.hit.shown, to.clone().sub(from.hit.shown));
  }

  drop() {
    if (this.to) this.view.showRope(null);
    this.from = this.to = null;
  }
}
