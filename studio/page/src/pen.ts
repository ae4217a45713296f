// SPDX-License-Identifier: GPL-3.0-or-later
// The pen: a line that sticks to the cloth while the button is down.
import type { Hit } from "./picker";
import type { View } from "./view";

/** `pressure`: the mean of a pen that feels it, 0.5 where it is held as usual. */
export interface Drawn {
  points: number[][];
  closed: boolean;
  pressure?: number;
}
export interface PenSettings {
  on: boolean;
  colour: number;
  width: number;
}
export interface PenHearer {
  drawn(line: Drawn): void;
  tooShort(): void;
}

/** Distances as shares of the cloth's size. */
const spacing = 0.004,
  longestJump = 0.1,
  shortest = 0.015;
/** Distances in the window [pixels]: between places that are looked at, from the cloth where a line may begin, and from
 *  a border that a line is taken to reach. */
const step = 3,
  beside = 40,
  short = 20;

export class Pen {
  private hits: Hit[] = [];
  private last?: [number, number];
  private first?: [number, number];
  private down = false;
  private pressures: number[] = [];

  constructor(
    private view: View,
    private settings: () => PenSettings,
    private hearer: PenHearer,
  ) {
    const canvas = view.canvas;
    // In the capturing phase, so that the camera stays where it is while a line is drawn.
    canvas.addEventListener("pointerdown", (e) => this.begin(e), { capture: true });
    canvas.addEventListener("pointermove", (e) => this.move(e), { capture: true });
    canvas.addEventListener("pointerup", (e) => this.end(e), { capture: true });
    canvas.addEventListener("pointercancel", () => this.drop(), { capture: true });
  }

  get drawing() {
    return this.down;
  }

  private begin(e: PointerEvent) {
    if (!this.settings().on || e.button !== 0 || this.down) return;
    const hit = this.view.picker.pick(e.clientX, e.clientY);
    if (!hit && !this.view.picker.isNear(e.clientX, e.clientY, beside)) return; // far from the cloth the camera turns
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    this.down = true;
    this.hits = hit ? [hit] : [];
    this.pressures = [];
    this.feel(e);
    this.first = this.last = [e.clientX, e.clientY];
  }

  private add(x: number, y: number) {
    const hit = this.view.picker.pick(x, y),
      before = this.hits[this.hits.length - 1];
    if (!hit) return;
    if (!before) return void this.hits.push(hit); // it came from beside the cloth
    const far = hit.shown.distanceTo(before.shown) / this.view.size;
    if (far >= spacing && far <= longestJump) this.hits.push(hit);
  }

  private addTo(x: number, y: number, from: [number, number]) {
    const n = Math.max(1, Math.ceil(Math.hypot(x - from[0], y - from[1]) / step));
    for (let i = 1; i <= n; ++i)
      this.add(from[0] + ((x - from[0]) * i) / n, from[1] + ((y - from[1]) * i) / n);
  }

  /** A mouse has no pressure, and a finger none that means anything. */
  private feel(e: PointerEvent) {
    if (e.pointerType === "pen" && e.pressure > 0) this.pressures.push(e.pressure);
  }

  private move(e: PointerEvent) {
    if (!this.down) return;
    e.stopImmediatePropagation();
    this.feel(e);
    if (e.shiftKey) {
      this.hits.length = Math.min(this.hits.length, 1);
      this.addTo(e.clientX, e.clientY, this.first!);
    } else {
      for (const place of e.getCoalescedEvents?.() ?? [e]) {
        this.addTo(place.clientX, place.clientY, this.last!);
        this.last = [place.clientX, place.clientY];
      }
    }
    this.last = [e.clientX, e.clientY];
    if (this.hits.length < 2) return;
    const { width, colour } = this.settings();
    this.view.showBand(this.isClosed() ? [...this.hits, this.hits[0]] : this.hits, width, colour);
  }

  private length() {
    return this.hits.reduce((sum, hit, i) => sum + (i ? hit.shown.distanceTo(this.hits[i - 1].shown) : 0), 0);
  }

  /** A line that ends near its start, and is no short one. */
  private isClosed() {
    if (this.hits.length < 8) return false;
    const gap = this.hits[0].shown.distanceTo(this.hits[this.hits.length - 1].shown);
    return gap < 0.03 * this.view.size && this.length() > 8 * gap && this.length() > 0.15 * this.view.size;
  }

  /** A line that ends just before a border is meant to reach it. */
  private reachBorders() {
    const reach = (end: Hit, before: Hit) =>
      this.view.picker.borderAhead(
        end,
        before,
        Math.min(short * this.view.picker.lengthOfPixel(end.shown), this.settings().width / 2),
      );
    const n = this.hits.length,
      back = Math.min(n - 1, 4);
    const last = reach(this.hits[n - 1], this.hits[n - 1 - back]),
      first = reach(this.hits[0], this.hits[back]);
    if (last) this.hits.push(last);
    if (first) this.hits.unshift(first);
  }

  private end(e: PointerEvent) {
    if (!this.down) return;
    e.stopImmediatePropagation();
    this.down = false;
    this.view.canvas.releasePointerCapture(e.pointerId);
    if (this.hits.length < 3 || this.length() < shortest * this.view.size) {
      this.drop();
      return this.hearer.tooShort();
    }
    const isClosed = this.isClosed();
    if (!isClosed) this.reachBorders();
    const felt = this.pressures,
      pressure = felt.length > 0 ? felt.reduce((sum, p) => sum + p, 0) / felt.length : undefined;
    this.hearer.drawn({ points: this.hits.map((h) => h.undrawn.toArray()), closed: isClosed, pressure });
  }

  /** Lets the line go. */
  drop() {
    this.down = false;
    this.hits = [];
    this.view.showBand([], 0, 0);
  }
}
