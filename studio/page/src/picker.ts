// SPDX-License-Identifier: GPL-3.0-or-later
// What of the cloth is pointed at: places of the window and of the cloth, by trees of its faces.
import * as THREE from "three";
import { MeshBVH } from "three-mesh-bvh";
import { type Frame, seamEdges } from "./frame";

export interface Hit {
  shown: THREE.Vector3;
  normal: THREE.Vector3;
  undrawn: THREE.Vector3;
  vertex: number;
}

/** What is pointed at, as it is seen now. */
export interface Scenery {
  readonly canvas: HTMLCanvasElement;
  readonly camera: THREE.PerspectiveCamera;
  readonly cloth: THREE.Mesh;
  readonly body: THREE.Mesh;
  readonly seen: { body: boolean };
  readonly size: number; // the cloth's diagonal [m]
  readonly frame?: Frame; // the cloth's
}

/** Edges that belong to one face. */
function borderEdges(faces: Uint32Array): [number, number][] {
  const edges = new Map<string, [number, number] | null>();
  for (let f = 0; f < faces.length; f += 3)
    for (let k = 0; k < 3; ++k) {
      const a = faces[f + k],
        b = faces[f + ((k + 1) % 3)],
        name = a < b ? `${a} ${b}` : `${b} ${a}`;
      edges.set(name, edges.has(name) ? null : [a, b]);
    }
  return [...edges.values()].filter((edge) => edge !== null);
}

export class Picker {
  private clothTree?: MeshBVH;
  private bodyTree?: MeshBVH;
  private undrawnTree?: MeshBVH; // of the present frame, where it was asked for
  private borders?: [number, number][]; // likewise: edges of one face
  private seams?: [number, number][]; // likewise
  private isOld = false; // things have moved since the trees were fitted
  private soon = 0;

  constructor(private readonly of: Scenery) {}

  /** Another cloth is seen. */
  forgetCloth() {
    this.clothTree = this.undrawnTree = this.borders = this.seams = undefined;
    this.fitSoon();
  }

  /** Another body is seen, or none. */
  forgetBody() {
    this.bodyTree = undefined;
    this.fitSoon();
  }

  /** Cloth or body have moved. */
  haveMoved() {
    this.isOld = true;
  }

  private fitSoon() {
    clearTimeout(this.soon);
    this.soon = window.setTimeout(() => this.fit(), 150);
  }

  private rayThrough(x: number, y: number): THREE.Ray {
    const box = this.of.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.of.camera);
    return caster.ray;
  }

  /** What is pointed at is found by trees: they are made after the picture, which nobody shall wait for. */
  private fit() {
    if (this.isOld) {
      this.clothTree?.refit();
      this.bodyTree?.refit();
      this.isOld = false;
    }
    if (this.of.cloth.geometry.index) this.clothTree ??= new MeshBVH(this.of.cloth.geometry);
    if (this.of.body.geometry.index) this.bodyTree ??= new MeshBVH(this.of.body.geometry);
  }

  /** The cloth under a place of the window, unless the body hides it. */
  pick(x: number, y: number): Hit | null {
    if (!this.of.frame) return null;
    this.fit();
    if (!this.clothTree) return null;
    const ray = this.rayThrough(x, y);
    const hit = this.clothTree.raycastFirst(ray, THREE.DoubleSide);
    if (!hit?.face) return null;
    const before = this.of.seen.body && this.bodyTree?.raycastFirst(ray, THREE.FrontSide);
    if (before && before.distance < hit.distance - 0.01 * this.of.size) return null;
    const { a, b, c } = hit.face;
    const at = (list: ArrayLike<number>, v: number) =>
      new THREE.Vector3(list[3 * v], list[3 * v + 1], list[3 * v + 2]);
    const { positions, undrawn } = this.of.frame;
    const weights = THREE.Triangle.getBarycoord(
      hit.point,
      at(positions, a),
      at(positions, b),
      at(positions, c),
      new THREE.Vector3(),
    );
    if (!weights) return null;
    const normals = this.of.cloth.geometry.getAttribute("normal").array;
    const blend = (list: ArrayLike<number>) =>
      at(list, a)
        .multiplyScalar(weights.x)
        .addScaledVector(at(list, b), weights.y)
        .addScaledVector(at(list, c), weights.z);
    const corner = weights.x >= weights.y && weights.x >= weights.z ? a : weights.y >= weights.z ? b : c;
    return {
      shown: hit.point.clone(),
      normal: blend(normals).normalize(),
      undrawn: blend(undrawn),
      vertex: corner,
    };
  }

  /** Whether cloth is within so many pixels of a place of the window, three times as many on the body. */
  isNear(x: number, y: number, pixels: number): boolean {
    this.fit();
    if (this.of.seen.body && this.bodyTree?.raycastFirst(this.rayThrough(x, y), THREE.FrontSide)) pixels *= 3;
    const around = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => (k * Math.PI) / 4);
    return [0.33, 0.67, 1].some((r) =>
      around.some((a) => this.pick(x + r * pixels * Math.cos(a), y + r * pixels * Math.sin(a)) !== null),
    );
  }

  /** How long a piece of the picture is where a point lies [m a pixel]. */
  lengthOfPixel(at: THREE.Vector3): number {
    const height = this.of.canvas.getBoundingClientRect().height;
    return (
      (2 * at.distanceTo(this.of.camera.position) * Math.tan((this.of.camera.fov * Math.PI) / 360)) / height
    );
  }

  /** The border of the cloth that a line runs towards at its end, within so much of it [m]; null: none. */
  borderAhead(end: Hit, before: Hit, most: number): Hit | null {
    this.borders ??= borderEdges(this.of.frame!.faces);
    const way = end.shown.clone().sub(before.shown).normalize();
    return this.nearestOf(
      this.borders,
      end,
      most,
      (on, far) => on.clone().sub(end.shown).dot(way) >= 0.5 * far,
    );
  }

  /** The seam that a line meets at its end, or has just crossed, within so much of it [m]; one that it runs along is
   *  none. null: none. */
  seamBeside(end: Hit, before: Hit, most: number): Hit | null {
    this.seams ??= seamEdges(this.of.frame!);
    const way = end.shown.clone().sub(before.shown).normalize();
    return this.nearestOf(this.seams, end, most, (_on, _far, along) => Math.abs(way.dot(along)) < 0.85);
  }

  /** The nearest place of edges to a hit, of those that are meant. */
  private nearestOf(
    edges: [number, number][],
    end: Hit,
    most: number,
    isMeant: (on: THREE.Vector3, far: number, along: THREE.Vector3) => boolean,
  ): Hit | null {
    const { positions, undrawn } = this.of.frame!,
      at = (list: Float32Array, v: number) => new THREE.Vector3().fromArray(list, 3 * v);
    const on = new THREE.Vector3(),
      along = new THREE.Vector3(),
      piece = new THREE.Line3();
    let best: Hit | null = null,
      least = most;
    for (const [a, b] of edges) {
      piece.set(at(positions, a), at(positions, b));
      const share = piece.closestPointToPointParameter(end.shown, true);
      piece.at(share, on);
      const far = on.distanceTo(end.shown);
      if (far > least || !isMeant(on, far, piece.delta(along).normalize())) continue;
      least = far;
      best = {
        shown: on.clone(),
        normal: end.normal,
        undrawn: at(undrawn, a).lerp(at(undrawn, b), share),
        vertex: share < 0.5 ? a : b,
      };
    }
    return best;
  }

  /** Where the ray through a place of the window meets the plane through a point that faces the camera. */
  dragTo(x: number, y: number, through: THREE.Vector3): THREE.Vector3 | null {
    const facing = new THREE.Plane().setFromNormalAndCoplanarPoint(
      this.of.camera.getWorldDirection(new THREE.Vector3()),
      through,
    );
    return this.rayThrough(x, y).intersectPlane(facing, new THREE.Vector3());
  }

  placeOf(vertex: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.of.frame!.positions, 3 * vertex);
  }

  /** The place of the window under which a point lies [pixels]. */
  windowPlace(point: THREE.Vector3): [number, number] {
    const box = this.of.canvas.getBoundingClientRect(),
      at = point.clone().project(this.of.camera);
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  }

  /** The vertices within a polygon of the window that are seen: nothing lies before them. */
  verticesIn(polygon: [number, number][]): number[] {
    if (!this.of.frame || polygon.length < 3) return [];
    this.fit();
    if (!this.clothTree) return [];
    const inside = (x: number, y: number) =>
      polygon.reduce((is, [ax, ay], i) => {
        const [bx, by] = polygon[(i + 1) % polygon.length];
        return ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax) ? !is : is;
      }, false);
    const found: number[] = [],
      eye = this.of.camera.position;
    for (let v = 0; 3 * v < this.of.frame.positions.length; ++v) {
      const at = this.placeOf(v),
        [x, y] = this.windowPlace(at);
      if (!inside(x, y)) continue;
      const ray = new THREE.Ray(eye, at.clone().sub(eye).normalize()),
        way = at.distanceTo(eye) - 0.004 * this.of.size;
      const cloth = this.clothTree.raycastFirst(ray, THREE.DoubleSide),
        body = this.of.seen.body && this.bodyTree?.raycastFirst(ray, THREE.FrontSide);
      if ((!cloth || cloth.distance > way) && (!body || body.distance > way - 0.006 * this.of.size))
        found.push(v);
    }
    return found;
  }

  /** The nearest point of the cloth without its lines, and the same point with them. */
  nearest(point: THREE.Vector3): { undrawn: THREE.Vector3; shown: THREE.Vector3 } | null {
    if (!this.of.frame) return null;
    const { positions, undrawn, faces } = this.of.frame;
    if (!this.undrawnTree) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(undrawn, 3));
      geometry.setIndex(new THREE.BufferAttribute(faces.slice(), 1));
      this.undrawnTree = new MeshBVH(geometry);
    }
    const hit = this.undrawnTree.closestPointToPoint(point);
    if (!hit) return null;
    const index = this.undrawnTree.geometry.index!.array,
      corners = [0, 1, 2].map((k) => index[3 * hit.faceIndex + k]);
    const at = (list: Float32Array, v: number) => new THREE.Vector3().fromArray(list, 3 * v);
    const [a, b, c] = corners.map((v) => at(undrawn, v));
    const w = THREE.Triangle.getBarycoord(hit.point, a, b, c, new THREE.Vector3());
    if (!w) return { undrawn: hit.point.clone(), shown: at(positions, corners[0]) };
    const shown = at(positions, corners[0])
      .multiplyScalar(w.x)
      .addScaledVector(at(positions, corners[1]), w.y)
      .addScaledVector(at(positions, corners[2]), w.z);
    return { undrawn: hit.point.clone(), shown };
  }
}
