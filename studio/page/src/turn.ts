// SPDX-License-Identifier: GPL-3.0-or-later
// Once round the cloth, as a picture that moves.
import { gifOf } from "./gif";
import type { View } from "./view";

const pictures = 40,
  side = 480, // [pixels]
  pause = 9; // [1/100 s]

export async function recordTurn(view: View): Promise<Uint8Array<ArrayBuffer>> {
  const canvas = document.createElement("canvas"),
    pen = canvas.getContext("2d", { willReadFrequently: true })!,
    taken: ImageData[] = [];
  canvas.width = canvas.height = side;
  await view.round(pictures, side, (seen) => {
    pen.drawImage(seen, 0, 0);
    taken.push(pen.getImageData(0, 0, side, side));
  });
  return gifOf(taken, pause);
}
