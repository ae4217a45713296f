// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as the program sends it (studio/frame_bytes.h).

export const enum Kind {
  cloth = 0,
  body = 1,
  preview = 2,
  moving = 3,
  colours = 4,
  movingBody = 5,
}

export interface Frame {
  kind: Kind;
  positions: Float32Array;
  undrawn: Float32Array; // where the vertices would lie without the heights of their lines
  faces: Uint32Array;
  edges: Int32Array; // from, to, line; or those of seams
  pinned: Uint32Array;
}

/** What stands for an edge of a seam in place of its line (jobs/draw/shown_mesh.h). */
const seam = -0x80000000;

export function seamEdges({ edges }: Frame): [number, number][] {
  const found: [number, number][] = [];
  for (let e = 0; e < edges.length; e += 3) if (isSeam(edges[e + 2])) found.push([edges[e], edges[e + 1]]);
  return found;
}

export const isSeam = (line: number) => line === seam;

/** Where the vertices of the cloth, or of the body, are while they move. */
export interface Moving {
  kind: Kind.moving | Kind.movingBody;
  time: number;
  positions: Float32Array;
}

/** Red, green and blue of each vertex, in [0, 255]. */
export interface Colours {
  kind: Kind.colours;
  colours: Uint8Array;
}

export function readFrame(bytes: ArrayBuffer): Frame | Moving | Colours {
  const start = new Uint32Array(bytes, 0, 4);
  if (start[0] !== 0x57525546) throw new Error("this is no mesh");
  if (start[1] === Kind.moving || start[1] === Kind.movingBody)
    return { kind: start[1], time: start[3] / 1000, positions: new Float32Array(bytes, 16, 3 * start[2]) };
  if (start[1] === Kind.colours)
    return { kind: Kind.colours, colours: new Uint8Array(bytes, 16, 3 * start[2]) };
  const head = new Uint32Array(bytes, 0, 6);
  const [, kind, vertices, faces, edges, pinned] = head;
  let at = 24;
  const take = <T>(make: new (b: ArrayBuffer, o: number, n: number) => T, n: number): T => {
    const list = new make(bytes, at, n);
    at += 4 * n;
    return list;
  };
  return {
    kind,
    positions: take(Float32Array, 3 * vertices),
    undrawn: take(Float32Array, 3 * vertices),
    faces: take(Uint32Array, 3 * faces),
    edges: take(Int32Array, 3 * edges),
    pinned: take(Uint32Array, pinned),
  };
}
