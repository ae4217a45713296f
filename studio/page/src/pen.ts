// SPDX-License-Identifier: GPL-3.0-or-later
// The pen: a line that sticks to the cloth while the button is down.
import type { Hit } from "./picker";
import { Ring } from "./ring";
import type { View } from "./view";

/** `pressures`: at each point, of a pen that feels it, 0.5 where it is held as usual. */
export interface Drawn {
  points: number[][];
  closed: boolean;
  pressures?: number[];
}
export interface PenSettings {
  on: boolean;
  colour: number;
  width: number;
  isValley: boolean;
}
export interface PenHearer {
  /** It feels pressure. */
  feels(): void;
  /** Its size is to be so many times what it was when a drag for it began, and now is. */
  sized(factor: number, isOver: boolean): void;
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
  short = 20,
  nearSeam = 14;
/** A drag for the pen's size that makes it e times as wide [pixels]. */
const forSize = 160;
/** Points before and after, over which pressure is evened out. */
const evened = 4;

export class Pen {
  private hits: Hit[] = [];
  private last?: [number, number];
  private first?: [number, number];
  private down = false;
  private pressure = 0; // now; 0: none is felt
  private pressures: number[] = []; // at each of the hits
  private sizing: { x: number; at: Hit } | null = null;
  readonly ring: Ring; // which a touch shows, too

  constructor(
    private view: View,
    private settings: () => PenSettings,
    private hearer: PenHearer,
  ) {
    const canvas = view.canvas;
    this.ring = new Ring(view);
    canvas.addEventListener("pointerleave", () => {
      if (this.sizing || this.down) return;
      this.last = undefined; // so that no ring comes back where the pen is no more
      this.ring.hide();
    });
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
    if (hit && (e.ctrlKey || e.metaKey)) return this.beginSizing(e, hit);
    if (!hit && !this.view.picker.isNear(e.clientX, e.clientY, beside)) return; // far from the cloth the camera turns
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    this.down = true;
    this.hits = [];
    this.pressures = [];
    this.feel(e);
    if (hit) this.take(hit);
    this.first = this.last = [e.clientX, e.clientY];
  }

  private beginSizing(e: PointerEvent, at: Hit) {
    e.stopImmediatePropagation();
    this.view.canvas.setPointerCapture(e.pointerId);
    this.sizing = { x: e.clientX, at };
  }

  private take(hit: Hit) {
    this.hits.push(hit);
    this.pressures.push(this.pressure);
  }

  private add(x: number, y: number) {
    const hit = this.view.picker.pick(x, y),
      before = this.hits[this.hits.length - 1];
    if (!hit) return;
    if (!before) return this.take(hit); // it came from beside the cloth
    const far = hit.shown.distanceTo(before.shown) / this.view.size;
    if (far >= spacing && far <= longestJump) this.take(hit);
  }

  private addTo(x: number, y: number, from: [number, number]) {
    const n = Math.max(1, Math.ceil(Math.hypot(x - from[0], y - from[1]) / step));
    for (let i = 1; i <= n; ++i)
      this.add(from[0] + ((x - from[0]) * i) / n, from[1] + ((y - from[1]) * i) / n);
  }

  /** A mouse has no pressure, and a finger none that means anything. */
  private feel(e: PointerEvent) {
    this.pressure = e.pointerType === "pen" ? e.pressure : 0;
    if (this.pressure > 0) this.hearer.feels();
  }

  /** Shows how wide it draws, where it is. */
  private showRing(hit: Hit | null, says = false) {
    const { on, width, isValley } = this.settings();
    if (on && hit) this.ring.show(hit, width, says ? `${Math.round(1000 * width)} mm` : "", isValley);
    else this.ring.hide();
  }

  /** After a change of its settings. `says`: tells how wide it is now. */
  follow(says = false) {
    const hit = this.last && !this.down ? this.view.picker.pick(...this.last) : null;
    this.showRing(this.sizing?.at ?? hit, says || this.sizing !== null);
  }

  private hover(e: PointerEvent) {
    if (!this.settings().on || e.buttons !== 0) return this.ring.hide();
    this.last = [e.clientX, e.clientY];
    this.follow();
  }

  private move(e: PointerEvent) {
    if (this.sizing) {
      e.stopImmediatePropagation();
      return this.hearer.sized(Math.exp((e.clientX - this.sizing.x) / forSize), false);
    }
    if (!this.down) return this.hover(e);
    e.stopImmediatePropagation();
    this.feel(e);
    if (e.shiftKey) {
      this.hits.length = this.pressures.length = Math.min(this.hits.length, 1);
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
    this.view.showBand(this.isClosed() ? [...this.hits, this.hits[0]] : this.snapped(e), width, colour);
    this.showRing(this.hits[this.hits.length - 1]);
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

  /** The line as its ends are meant: one that lies by a seam lies on it, and one just before a border reaches it.
   *  With Alt they stay where they are. */
  private snapped(e: PointerEvent): Hit[] {
    if (e.altKey || this.hits.length < 3) return this.hits;
    return this.reached(this.reached(this.hits).reverse()).reverse();
  }

  private reached(hits: Hit[]): Hit[] {
    const end = hits[hits.length - 1],
      before = hits[Math.max(0, hits.length - 5)],
      pixel = this.view.picker.lengthOfPixel(end.shown);
    const near = nearSeam * pixel,
      onSeam = this.view.picker.seamBeside(end, before, near);
    if (onSeam) {
      // What went past the seam, or to just before it, is not drawn.
      let n = hits.length;
      while (n > 2 && hits[n - 1].shown.distanceTo(onSeam.shown) < near) --n;
      return [...hits.slice(0, n), onSeam];
    }
    const onBorder = this.view.picker.borderAhead(
      end,
      before,
      Math.min(short * pixel, this.settings().width / 2),
    );
    return onBorder ? [...hits, onBorder] : [...hits];
  }

  /** At each of `hits`, which are those of the pen with other ends: evened out; none: none was felt. */
  private pressuresAt(hits: Hit[]): number[] | undefined {
    if (!this.pressures.some((p) => p > 0)) return undefined;
    const even = this.pressures.map((_, i) => {
      const near = this.pressures.slice(Math.max(0, i - evened), i + evened + 1).filter((p) => p > 0);
      return near.length ? near.reduce((sum, p) => sum + p, 0) / near.length : 0.5;
    });
    const own = hits.map((hit) => this.hits.indexOf(hit)),
      first = own.find((i) => i >= 0)!,
      last = own.filter((i) => i >= 0).pop()!;
    return own.map((i, k) => even[i >= 0 ? i : k < hits.length / 2 ? first : last]);
  }

  private end(e: PointerEvent) {
    if (this.sizing) {
      e.stopImmediatePropagation();
      this.view.canvas.releasePointerCapture(e.pointerId);
      const factor = Math.exp((e.clientX - this.sizing.x) / forSize);
      this.sizing = null;
      return this.hearer.sized(factor, true);
    }
    if (!this.down) return;
    e.stopImmediatePropagation();
    this.down = false;
    this.view.canvas.releasePointerCapture(e.pointerId);
    if (this.hits.length < 3 || this.length() < shortest * this.view.size) {
      this.drop();
      return this.hearer.tooShort();
    }
    const closed = this.isClosed(),
      hits = closed ? this.hits : this.snapped(e);
    this.hearer.drawn({
      points: hits.map((h) => h.undrawn.toArray()),
      closed,
      pressures: this.pressuresAt(hits),
    });
  }

  /** Lets the line go. */
  drop() {
    this.down = false;
    this.sizing = null;
    this.hits = [];
    this.view.showBand([], 0, 0);
  }
}
