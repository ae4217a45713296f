// SPDX-License-Identifier: GPL-3.0-or-later
// The hand: while the cloth moves, it is pulled by the pointer; with the pin tool, a click holds a vertex, and
// what is encircled is held, or with Shift let go.
import * as THREE from "three";
import type { Vector } from "./protocol";
import type { Hit } from "./picker";
import type { View } from "./view";

export interface HandHearer {
  /** null: it lets go. */
  pulls(grip: { vertex: number; to: Vector } | null): void;
  /** `border`: the whole border near there is meant. */
  pins(at: Vector, border: boolean): void;
  /** `on`: what was encircled is to be held, else let go. */
  encircles(vertices: number[], on: boolean): void;
}

export class Hand {
  private vertex = -1;
  private from = new THREE.Vector3(); // where the cloth was taken
  private to = new THREE.Vector3();
  private lasso: [number, number][] = []; // of the window
  private clicked: Hit | null = null; // where it began
  private trail: SVGPolylineElement;

  constructor(
    private view: View,
    private does: () => "pull" | "pin" | "",
    private hearer: HandHearer,
  ) {
    const canvas = view.canvas,
      svg = "http://www.w3.org/2000/svg",
      picture = document.createElementNS(svg, "svg");
    picture.setAttribute("class", "trail");
    picture.setAttribute("aria-hidden", "true");
    this.trail = picture.appendChild(document.createElementNS(svg, "polyline"));
    canvas.after(picture);
    canvas.addEventListener("pointerdown", (e) => this.begin(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
    canvas.addEventListener("pointerup", (e) => this.end(e), { capture: true });
    canvas.addEventListener("pointercancel", () => this.drop(), { capture: true });
  }

  private begin(e: PointerEvent) {
    const does = this.does();
    if (!does || e.button !== 0) return;
    const hit: Hit | null = this.view.picker.pick(e.clientX, e.clientY);
    if (!hit) return; // beside the cloth the camera turns
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    if (does === "pin") {
      this.clicked = hit;
      this.lasso = [[e.clientX, e.clientY]];
      return;
    }
    this.vertex = hit.vertex;
    this.from = this.view.picker.placeOf(hit.vertex);
    this.pull(this.from);
  }

  private pull(to: THREE.Vector3) {
    this.to = to;
    this.hearer.pulls({ vertex: this.vertex, to: to.toArray() as Vector });
    this.follow();
  }

  /** Draws the rope anew, as the cloth has moved. */
  follow() {
    if (this.vertex >= 0) this.view.showRope([this.view.picker.placeOf(this.vertex), this.to]);
  }

  private move(e: PointerEvent) {
    if (this.clicked) {
      e.stopImmediatePropagation();
      const [x, y] = this.lasso[this.lasso.length - 1];
      if (Math.hypot(e.clientX - x, e.clientY - y) > 3) this.lasso.push([e.clientX, e.clientY]);
      return this.showTrail();
    }
    if (this.vertex < 0) return;
    e.stopImmediatePropagation();
    const to = this.view.picker.dragTo(e.clientX, e.clientY, this.from);
    if (to) this.pull(to);
  }

  get encircling() {
    return this.clicked !== null;
  }

  private showTrail() {
    const box = this.view.canvas.getBoundingClientRect();
    const points = this.isClick() ? [] : this.lasso;
    this.trail.setAttribute(
      "points",
      points.map(([x, y]) => `${(x - box.left).toFixed(1)},${(y - box.top).toFixed(1)}`).join(" "),
    );
  }

  /** Whether the pointer has hardly moved. */
  private isClick() {
    const [[x, y]] = this.lasso;
    return this.lasso.every((p) => Math.hypot(p[0] - x, p[1] - y) < 8);
  }

  private end(e: PointerEvent) {
    const { clicked, lasso } = this;
    if (!clicked) return this.drop();
    const isClick = this.isClick();
    this.drop();
    if (isClick) return this.hearer.pins(clicked.undrawn.toArray() as Vector, e.shiftKey);
    this.hearer.encircles(this.view.picker.verticesIn(lasso), !e.shiftKey);
  }

  /** Lets the cloth go, and what is encircled. */
  drop() {
    this.clicked = null;
    this.lasso = [];
    this.trail.setAttribute("points", "");
    if (this.vertex < 0) return;
    this.vertex = -1;
    this.view.showRope(null);
    this.hearer.pulls(null);
  }
}
