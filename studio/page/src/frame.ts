// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as the program sends it (studio/frame_bytes.h).

export const enum Kind { cloth = 0, body = 1, preview = 2 }

export interface Frame {
  kind: Kind;
  positions: Float32Array;
  undrawn: Float32Array;  // where the vertices would lie without the heights of their lines
  faces: Uint32Array;
  edges: Int32Array;      // from, to, line
  pinned: Uint32Array;
}

export function readFrame(bytes: ArrayBuffer): Frame {
  const head = new Uint32Array(bytes, 0, 6);
  if (head[0] !== 0x57525546) throw new Error("this is no mesh");
  const [, kind, vertices, faces, edges, pinned] = head;
  let at = 24;
  const take = <T>(make: new (b: ArrayBuffer, o: number, n: number) => T, n: number): T => {
    const list = new make(bytes, at, n);
    at += 4 * n;
    return list;
  };
  return {
    kind, positions: take(Float32Array, 3 * vertices), undrawn: take(Float32Array, 3 * vertices), faces: take(Uint32Array, 3 * faces),
    edges: take(Int32Array, 3 * edges), pinned: take(Uint32Array, pinned),
  };
}
