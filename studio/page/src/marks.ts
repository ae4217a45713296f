// SPDX-License-Identifier: GPL-3.0-or-later
// Marks on the cloth that leave its folds to be seen: each line as a thin stitch along the foot of its fold, which
// fades once it has been seen, and what became of a line as a sign at its end.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { type Frame, isSeam } from "./frame";
import type { Vector, Verdict } from "./protocol";
import type { View } from "./view";

/** A line that is shown: whether it is a ridge (1) or a valley (-1), and how wide its fold is [m]. */
export interface Mark {
  sign: number;
  width: number;
}

/** Times [ms]: until the cloth is taken to be at rest, that all lines are seen then, and of one step of fading. */
const calm = 160,
  seenFor = 2000,
  fading = 100;
/** Lengths [shares of the cloth's size]: beside a fold's foot, of a stitch, between stitches, above the cloth, and from
 *  the crest of a line whose width is not known any more. */
const beside = 0.004,
  stitch = 0.012,
  gap = 0.008,
  above = 0.001,
  ofUnknown = 0.03;

/** Vertices of lines in their order, each line from its upper end on. Edges of seams have no line. */
export function chainsOf({ edges, positions }: Frame): Map<number, number[][]> {
  const neighbours = new Map<number, Map<number, number[]>>();
  for (let e = 0; e < edges.length; e += 3) {
    if (isSeam(edges[e + 2])) continue;
    const line = Math.max(edges[e + 2], -1);
    if (!neighbours.has(line)) neighbours.set(line, new Map());
    const of = neighbours.get(line)!;
    for (const [a, b] of [
      [edges[e], edges[e + 1]],
      [edges[e + 1], edges[e]],
    ])
      of.set(a, [...(of.get(a) ?? []), b]);
  }
  const chains = new Map<number, number[][]>(),
    height = (v: number) => positions[3 * v + 1];
  for (const [line, of] of neighbours) {
    const left = new Set(of.keys()),
      found: number[][] = [];
    while (left.size > 0) {
      const ends = [...left].filter((v) => of.get(v)!.filter((n) => left.has(n)).length < 2);
      let at: number | undefined = (ends.length ? ends : [...left]).reduce((a, b) =>
        height(a) >= height(b) ? a : b,
      );
      const first = at,
        chain: number[] = [];
      while (at !== undefined) {
        chain.push(at);
        left.delete(at);
        at = of.get(at)!.find((n) => left.has(n));
      }
      const isClosed = chain.length > 2 && of.get(chain[chain.length - 1])!.includes(first);
      if (isClosed) chain.push(first);
      if (chain.length > 1) found.push(chain);
    }
    chains.set(line, found);
  }
  return chains;
}

const signs: Record<Verdict["verdict"], [string, string]> = {
  held: ["#2c8a4f", "✓"],
  pressed: ["#b98a00", "✓"],
  strutted: ["#c65f12", "✓"],
  lowered: ["#3763c4", "↓"],
  may_hold: ["#8446b8", "?"],
  cannot_hold: ["#c42832", "✕"],
  not_known: ["#6b7078", "?"],
};

/** A round sign as it stands before the cloth, and behind what lies well before it. */
function signOf(verdict: Verdict["verdict"]): THREE.Sprite {
  const [colour, letter] = signs[verdict],
    canvas = document.createElement("canvas"),
    pen = canvas.getContext("2d")!;
  canvas.width = canvas.height = 64;
  pen.fillStyle = colour;
  pen.strokeStyle = "#ffffff";
  pen.lineWidth = 5;
  pen.beginPath();
  pen.arc(32, 32, 28, 0, 2 * Math.PI);
  pen.fill();
  pen.stroke();
  pen.fillStyle = "#ffffff";
  pen.font = "bold 38px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(letter, 32, 35);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(
    new THREE.SpriteMaterial({
      map,
      sizeAttenuation: false,
      polygonOffset: true,
      polygonOffsetUnits: -3000,
      depthWrite: false,
    }),
  );
  sprite.scale.setScalar(0.021);
  sprite.center.set(0.5, 0);
  return sprite;
}

export class Marks {
  readonly group = new THREE.Group();
  readonly signs = new THREE.Group();
  private of: Mark[] = [];
  private chosen = -1;
  private pointed: number | null = null;
  private opacity = 0; // of lines that are neither chosen nor pointed at
  private soon = 0;
  private crests = new Map<number, THREE.Vector3[]>(); // of each line, on the cloth

  constructor(private view: View) {}

  /** Of the lines that are shown; `chosen`: the one that is seen as long as it is. */
  mark(of: Mark[], chosen: number) {
    const isOther = JSON.stringify(of) !== JSON.stringify(this.of);
    this.of = of;
    this.chosen = chosen;
    if (isOther) this.renew();
    else this.fade();
  }

  /** The line that the pointer is over; null: none. Those that a drape or a keep made cloth are -1. */
  point(line: number | null) {
    if (line === this.pointed) return;
    this.pointed = line;
    this.fade();
  }

  /** The line whose fold lies under a place of the window; null: none. */
  lineAt(x: number, y: number): number | null {
    const hit = this.crests.size > 0 && this.view.picker.pick(x, y);
    if (!hit) return null;
    let best: number | null = null,
      least = Infinity;
    for (const [line, crest] of this.crests)
      for (const p of crest) {
        const far = p.distanceTo(hit.shown) / this.reach(line);
        if (far < Math.min(least, 1.2)) [best, least] = [line, far];
      }
    return best;
  }

  private reach(line: number) {
    const width = this.of[line]?.width;
    return width ? width / 2 + beside * this.view.size : ofUnknown * this.view.size;
  }

  /** Another cloth is seen: the old marks go at once, and new ones come when it holds still. */
  renew() {
    this.clear();
    clearTimeout(this.soon);
    if (!this.view.frame || chainsOf(this.view.frame).size === 0)
      return void delete this.view.canvas.dataset.fresh;
    this.view.canvas.dataset.fresh = ""; // which is for tests: lines are about to fade
    this.soon = window.setTimeout(() => this.sew(), calm);
  }

  clear() {
    for (const child of [...this.group.children] as LineSegments2[]) {
      child.geometry.dispose();
      child.material.dispose();
      this.group.remove(child);
    }
    this.crests.clear();
  }

  private sew() {
    const { frame, colours } = this.view;
    if (!frame) return;
    for (const [line, chains] of chainsOf(frame)) {
      const points: number[] = [],
        crest: THREE.Vector3[] = [];
      for (const chain of chains) {
        const feet = this.footOf(frame, chain, this.reach(line));
        feet.slice(1).forEach((p, i) => points.push(...feet[i].toArray(), ...p.toArray()));
        crest.push(...chain.map((v) => this.view.picker.placeOf(v)));
      }
      if (points.length === 0) continue;
      this.crests.set(line, crest);
      const geometry = new LineSegmentsGeometry();
      geometry.setPositions(points);
      const kind = this.of[line]?.sign < 0 ? colours.valley : colours.ridge;
      const material = new LineMaterial({
        color: line < 0 ? 0x6f7276 : kind,
        dashed: true,
        dashSize: stitch * this.view.size,
        gapSize: gap * this.view.size,
        transparent: true,
      });
      const sewn = new LineSegments2(geometry, material).computeLineDistances();
      sewn.userData.line = line;
      this.group.add(sewn);
    }
    this.opacity = 1;
    this.fade();
    this.soon = window.setTimeout(() => this.fadeOn(), seenFor);
  }

  /** A line's points, moved over the cloth to the foot of its fold, to the right as one looks down along it. */
  private footOf(frame: Frame, chain: number[], reach: number): THREE.Vector3[] {
    const normals = this.view.cloth.geometry.getAttribute("normal").array,
      at = (list: ArrayLike<number>, v: number) =>
        new THREE.Vector3(list[3 * v], list[3 * v + 1], list[3 * v + 2]),
      lift = above * this.view.size;
    return chain.map((v, i) => {
      const from = at(frame.undrawn, chain[Math.max(i - 1, 0)]),
        to = at(frame.undrawn, chain[Math.min(i + 1, chain.length - 1)]),
        normal = at(normals, v),
        here = at(frame.undrawn, v);
      const across = to.sub(from).cross(normal).normalize(),
        near = this.view.picker.nearest(here.clone().addScaledVector(across, reach));
      const isNear = near && near.undrawn.distanceTo(here) < 1.5 * reach;
      return (isNear ? near.shown : at(frame.positions, v)).addScaledVector(normal, lift);
    });
  }

  private fadeOn() {
    this.opacity = Math.max(0, this.opacity - 0.25);
    this.fade();
    if (this.opacity > 0) this.soon = window.setTimeout(() => this.fadeOn(), fading);
    else delete this.view.canvas.dataset.fresh;
  }

  private fade() {
    for (const sewn of this.group.children as LineSegments2[]) {
      const { line } = sewn.userData,
        isMeant = line === this.pointed || (line >= 0 && line === this.chosen);
      sewn.material.opacity = isMeant ? 1 : this.opacity;
      sewn.material.linewidth = isMeant ? 3 : 2;
      sewn.visible = sewn.material.opacity > 0;
    }
    this.view.draw();
  }

  /** What became of lines, at their ends. */
  judge(verdicts: Verdict[]) {
    for (const sign of [...this.signs.children] as THREE.Sprite[]) {
      sign.material.map?.dispose();
      sign.material.dispose();
      this.signs.remove(sign);
    }
    for (const { verdict, at } of verdicts) {
      if (!at) continue;
      const sign = signOf(verdict);
      sign.position.set(...(at as Vector));
      this.signs.add(sign);
    }
    this.view.draw();
  }
}
