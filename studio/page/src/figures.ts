// SPDX-License-Identifier: GPL-3.0-or-later
// A GLB may hold several figures, as an avatar and its clothes: which are there.

interface Node {
  name?: string;
  mesh?: number;
}

/** The names of a GLB's nodes with a mesh, each once; none of any other file. */
export async function figuresOf(file: File): Promise<string[]> {
  const head = new DataView(await file.slice(0, 20).arrayBuffer());
  if (head.byteLength < 20 || head.getUint32(0, true) !== 0x46546c67) return [];
  try {
    const scene = JSON.parse(await file.slice(20, 20 + head.getUint32(12, true)).text()) as {
      nodes?: Node[];
      meshes?: Node[];
    };
    const shown = (scene.nodes ?? []).filter((node) => node.mesh !== undefined);
    return [...new Set(shown.map((node) => node.name || scene.meshes?.[node.mesh!]?.name || ""))].filter(
      Boolean,
    );
  } catch {
    return []; // the program says what is wrong with it
  }
}
