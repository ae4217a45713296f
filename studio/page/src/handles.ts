// SPDX-License-Identifier: GPL-3.0-or-later
// Dots on the chosen line, by which it is dragged over the cloth. What lies between the dragged dot and its
// neighbours follows it, less and less, and stays on the cloth.
import * as THREE from "three";
import type { Vector } from "./protocol";
import type { View } from "./view";

export interface HandleHearer {
  moved(points: Vector[], live: boolean): void;
  /** It lies where it was. */
  dropped(): void;
}

/** Pixels within which a dot is meant; dots of a line; their distance as a share of the cloth's size. */
const near = 14,
  most = 12,
  apart = 0.06;

export class Handles {
  private points: THREE.Vector3[] = []; // of the line, on the cloth without its lines
  private base: THREE.Vector3[] = []; // before the drag
  private closed = false;
  private dots: number[] = []; // which of the points have a dot
  private grabbed = -1;

  constructor(
    private view: View,
    private on: () => boolean,
    private hearer: HandleHearer,
  ) {
    const canvas = view.canvas;
    canvas.addEventListener("pointerdown", (e) => this.begin(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
    canvas.addEventListener("pointerup", (e) => this.end(e), { capture: true });
    canvas.addEventListener("pointercancel", () => this.drop(), { capture: true });
  }

  get dragging() {
    return this.grabbed >= 0;
  }

  /** The line to be dragged; an empty list: none. */
  take(points: Vector[], closed: boolean) {
    if (this.dragging) return;
    this.points = points.map((p) => new THREE.Vector3(...p));
    this.closed = closed;
    const length = this.points.reduce((sum, p, i) => sum + (i ? p.distanceTo(this.points[i - 1]) : 0), 0);
    const n = Math.min(
      most,
      this.points.length,
      Math.max(3, Math.round(length / (apart * this.view.size)) + 1),
    );
    this.dots =
      this.points.length < 2
        ? []
        : Array.from({ length: n }, (_, k) =>
            Math.round((k * (this.points.length - 1)) / (n - (closed ? 0 : 1))),
          );
    this.dots = [...new Set(this.dots.filter((i) => i < this.points.length))];
    this.show();
  }

  /** Puts the dots where the cloth is now. */
  show() {
    this.view.showHandles(
      this.on()
        ? this.dots.map((i) => this.view.picker.nearest(this.points[i])?.shown ?? this.points[i])
        : [],
    );
  }

  private begin(e: PointerEvent) {
    if (!this.on() || e.button !== 0 || this.dots.length === 0) return;
    let best = near;
    this.dots.forEach((i, k) => {
      const shown = this.view.picker.nearest(this.points[i])?.shown;
      if (!shown) return;
      const [x, y] = this.view.picker.windowPlace(shown),
        far = Math.hypot(x - e.clientX, y - e.clientY);
      const hit = this.view.picker.pick(x, y);
      const hidden = !hit || hit.shown.distanceTo(shown) > 0.05 * this.view.size; // behind the cloth, or the body
      if (far < best && !hidden) {
        best = far;
        this.grabbed = k;
      }
    });
    if (!this.dragging) return;
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    this.base = this.points.map((p) => p.clone());
  }

  /** 1 at the grabbed dot, falling to 0 at its neighbours. */
  private share(i: number) {
    const at = this.dots[this.grabbed],
      n = this.points.length,
      dots = this.dots;
    const before =
      this.grabbed > 0 ? at - dots[this.grabbed - 1] : this.closed ? n - dots[dots.length - 1] : 1;
    const after = this.grabbed < dots.length - 1 ? dots[this.grabbed + 1] - at : this.closed ? n - at : 1;
    let off = i - at;
    if (this.closed && off > n / 2) off -= n;
    if (this.closed && off < -n / 2) off += n;
    const far = Math.abs(off) / Math.max(1, off < 0 ? before : after);
    return far >= 1 ? 0 : 0.5 + 0.5 * Math.cos(Math.PI * far);
  }

  private move(e: PointerEvent) {
    if (!this.dragging) return;
    e.stopImmediatePropagation();
    const hit = this.view.picker.pick(e.clientX, e.clientY);
    if (!hit) return;
    const way = hit.undrawn.clone().sub(this.base[this.dots[this.grabbed]]);
    this.points = this.base.map((p, i) => {
      const share = this.share(i);
      if (share === 0) return p.clone();
      const wanted = p.clone().addScaledVector(way, share);
      return share === 1 ? hit.undrawn.clone() : (this.view.picker.nearest(wanted)?.undrawn ?? wanted);
    });
    this.show();
    this.hearer.moved(this.list(), true);
  }

  private end(e: PointerEvent) {
    if (!this.dragging) return;
    e.stopImmediatePropagation();
    this.grabbed = -1;
    this.view.canvas.releasePointerCapture(e.pointerId);
    const moved = this.points.some((p, i) => p.distanceTo(this.base[i]) > 1e-5 * this.view.size);
    if (moved) this.hearer.moved(this.list(), false);
    else this.hearer.dropped();
  }

  /** Lets the dot go, and the line lie where it was. */
  drop() {
    if (!this.dragging) return;
    this.grabbed = -1;
    this.points = this.base;
    this.show();
    this.hearer.dropped();
  }

  private list() {
    return this.points.map((p) => p.toArray() as Vector);
  }
}
