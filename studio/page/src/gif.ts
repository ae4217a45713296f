// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that move, as GIF 89a: 256 colours for all pictures together, each packed by LZW.

/** Colours are counted by their upper bits. */
const bits = 6,
  shift = 8 - bits,
  bins = 1 << (3 * bits);
const binOf = (r: number, g: number, b: number) =>
  ((r >> shift) << (2 * bits)) | ((g >> shift) << bits) | (b >> shift);
const middle = (bin: number, k: number) =>
  (((bin >> ((2 - k) * bits)) & ((1 << bits) - 1)) << shift) + (1 << (shift - 1));

/** Halves boxes of colours at their median, those of most pixels times longest side first, down to `most` means. */
function coloursOf(count: Uint32Array, most: number): number[][] {
  const used = [...count.keys()].filter((bin) => count[bin] > 0),
    weigh = (box: number[]) => box.reduce((sum, bin) => sum + count[bin], 0);
  const longest = (box: number[]) =>
    [0, 1, 2]
      .map((k) => {
        const values = box.map((bin) => middle(bin, k));
        return [values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b)), k];
      })
      .reduce((a, b) => (b[0] > a[0] ? b : a));
  const measured = (box: number[]) => {
    const [length, axis] = longest(box);
    return { box, axis, rank: length * Math.sqrt(weigh(box)) };
  };
  const boxes = [measured(used)];
  while (boxes.length < most) {
    const at = boxes.reduce((best, { rank }, i) => (rank > boxes[best].rank ? i : best), 0),
      { box, axis, rank } = boxes[at];
    if (rank === 0) break;
    box.sort((a, b) => middle(a, axis) - middle(b, axis));
    let sum = 0,
      cut = 0;
    const half = weigh(box) / 2;
    while (cut < box.length - 1 && (sum += count[box[cut]]) < half) ++cut;
    cut = Math.max(1, cut);
    boxes.splice(at, 1, measured(box.slice(0, cut)), measured(box.slice(cut)));
  }
  return boxes.map(({ box }) =>
    [0, 1, 2].map((k) =>
      Math.round(box.reduce((sum, bin) => sum + count[bin] * middle(bin, k), 0) / weigh(box)),
    ),
  );
}

/** Codes of so many bits, the lowest bits first, in blocks of at most 255 bytes. */
class Codes {
  readonly bytes: number[] = [8]; // the size of a colour's index [bits]
  size = 9;
  private block: number[] = [];
  private held = 0;
  private have = 0;

  put(code: number) {
    this.held |= code << this.have;
    for (this.have += this.size; this.have >= 8; this.have -= 8, this.held >>= 8) this.add(this.held & 255);
  }

  private add(byte: number) {
    if (this.block.push(byte) < 255) return;
    this.bytes.push(255, ...this.block);
    this.block = [];
  }

  end(): number[] {
    if (this.have > 0) this.block.push(this.held & 255);
    if (this.block.length > 0) this.bytes.push(this.block.length, ...this.block);
    this.bytes.push(0);
    return this.bytes;
  }
}

/** A picture's indices, packed. */
function packed(indices: Uint8Array): number[] {
  const again = 256,
    end = 257,
    first = 258,
    most = 4096;
  const codes = new Codes(),
    next = new Int16Array(most * 256); // the string that a string and a further index make; 0: none yet
  let string = indices[0],
    free = first;
  codes.put(again);
  for (const index of indices.subarray(1)) {
    const at = 256 * string + index;
    if (next[at]) {
      string = next[at];
      continue;
    }
    codes.put(string);
    string = index;
    if (free < most) {
      if (free === 1 << codes.size) ++codes.size;
      next[at] = free++;
      continue;
    }
    codes.put(again);
    next.fill(0);
    codes.size = 9;
    free = first;
  }
  codes.put(string);
  if (free === 1 << codes.size && codes.size < 12) ++codes.size;
  codes.put(end);
  return codes.end();
}

/** `pictures`: of one size, red, green, blue and alpha of each pixel; `pause`: between them [1/100 s]. */
export function gifOf(pictures: ImageData[], pause: number): Uint8Array<ArrayBuffer> {
  const { width, height } = pictures[0],
    count = new Uint32Array(bins);
  for (const { data } of pictures)
    for (let i = 0; i < data.length; i += 4) ++count[binOf(data[i], data[i + 1], data[i + 2])];
  const colours = coloursOf(count, 256),
    nearest = new Int16Array(bins).fill(-1);
  const indexOf = (bin: number) => {
    if (nearest[bin] >= 0) return nearest[bin];
    const far = colours.map((c) => c.reduce((sum, v, k) => sum + (v - middle(bin, k)) ** 2, 0));
    return (nearest[bin] = far.indexOf(Math.min(...far)));
  };
  const two = (n: number) => [n & 255, n >> 8],
    text = (words: string) => [...words].map((c) => c.charCodeAt(0)),
    table = Array.from({ length: 256 }, (_, i) => colours[i] ?? [0, 0, 0]).flat();
  const parts: ArrayLike<number>[] = [
    [...text("GIF89a"), ...two(width), ...two(height), 0xf7, 0, 0, ...table],
    [0x21, 0xff, 11, ...text("NETSCAPE2.0"), 3, 1, 0, 0, 0], // for ever
  ];
  for (const { data } of pictures) {
    const indices = Uint8Array.from({ length: width * height }, (_, i) =>
      indexOf(binOf(data[4 * i], data[4 * i + 1], data[4 * i + 2])),
    );
    parts.push(
      [0x21, 0xf9, 4, 4, ...two(pause), 0, 0, 0x2c, 0, 0, 0, 0, ...two(width), ...two(height), 0],
      packed(indices),
    );
  }
  parts.push([0x3b]);
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => (bytes.set(part, at), at + part.length), 0);
  return bytes;
}
