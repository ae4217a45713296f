// SPDX-License-Identifier: GPL-3.0-or-later
// The hand: while the cloth moves, it is pulled by the pointer; with the pin tool, a click holds it.
import * as THREE from "three";
import type { Vector } from "./protocol";
import type { Hit, View } from "./view";

export interface HandHearer {
  /** null: it lets go. */
  pulls(grip: { vertex: number; to: Vector } | null): void;
  /** `border`: the whole border near there is meant. */
  pins(at: Vector, border: boolean): void;
}

export class Hand {
  private vertex = -1;
  private from = new THREE.Vector3();  // where the cloth was taken
  private to = new THREE.Vector3();

  constructor(private view: View, private does: () => "pull" | "pin" | "", private hearer: HandHearer) {
    const canvas = view.canvas;
    canvas.addEventListener("pointerdown", (e) => this.begin(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
    canvas.addEventListener("pointerup", () => this.drop(), { capture: true });
    canvas.addEventListener("pointercancel", () => this.drop(), { capture: true });
  }

  private begin(e: PointerEvent) {
    const does = this.does();
    if (!does || e.button !== 0) return;
    const hit: Hit | null = this.view.pick(e.clientX, e.clientY);
    if (!hit) return;  // beside the cloth the camera turns
    e.stopImmediatePropagation();
    if (does === "pin") return this.hearer.pins(hit.undrawn.toArray() as Vector, e.shiftKey);
    this.view.canvas.setPointerCapture(e.pointerId);
    this.vertex = hit.vertex;
    this.from = this.view.placeOf(hit.vertex);
    this.pull(this.from);
  }

  private pull(to: THREE.Vector3) {
    this.to = to;
    this.hearer.pulls({ vertex: this.vertex, to: to.toArray() as Vector });
    this.follow();
  }

  /** Draws the rope anew, as the cloth has moved. */
  follow() {
    if (this.vertex >= 0) this.view.showRope([this.view.placeOf(this.vertex), this.to]);
  }

  private move(e: PointerEvent) {
    if (this.vertex < 0) return;
    e.stopImmediatePropagation();
    const to = this.view.dragTo(e.clientX, e.clientY, this.from);
    if (to) this.pull(to);
  }

  /** Lets the cloth go. */
  drop() {
    if (this.vertex < 0) return;
    this.vertex = -1;
    this.view.showRope(null);
    this.hearer.pulls(null);
  }
}
