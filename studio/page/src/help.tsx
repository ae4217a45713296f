// SPDX-License-Identifier: GPL-3.0-or-later
import { useEffect, useRef } from "preact/hooks";

const keys: [string, string][] = [
  ["R", "ridge pen"],
  ["V", "valley pen"],
  ["[ ]", "a smaller or a larger pen; or drag to a side on the cloth with Ctrl"],
  ["Shift", "while drawing: a straight line"],
  ["Alt", "while drawing: its ends stay beside seams and borders"],
  ["Esc", "drop the line, or lay the pen down"],
  ["Ctrl Z", "undo"],
  ["Ctrl Y", "do again"],
  ["Ctrl S", "save"],
  ["O", "open another garment"],
  ["Delete", "delete the chosen line"],
  ["M", "mirror it; while a pen is up: draw on both sides"],
  ["Ctrl D", "duplicate it"],
  ["Alt ↑ ↓", "move it in the order of lines"],
  ["F", "frame the cloth"],
  ["1 2 3", "front, back, side"],
  ["← → ↑ ↓", "turn (with the picture in focus)"],
  ["+ −", "nearer, farther"],
  ["B", "body"],
  ["W", "wireframe"],
  ["C", "the shape alone, as of clay"],
  ["L", "lines"],
  ["Space", "play, pause"],
  ["D", "drape: let it come to rest"],
  ["K", "keep: make the lines last"],
  ["P", "pin by clicks, with Shift a whole border; or all within a loop that is drawn, with Shift to let go"],
  ["I", "touch cloth at rest: a click irons, steams or pinches it, a drag pulls it"],
  ["T", "tangles: where cloth crosses cloth"],
  ["?", "this page"],
];

export function Help({ close }: { close: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  return (
    <dialog ref={dialog} onClose={close} aria-labelledby="help-title">
      <h2 id="help-title" tabIndex={-1} autofocus>
        How it works
      </h2>
      <p>
        Pick the ridge or the valley pen and draw on the cloth: it wrinkles there when you lift the pen. A
        line that begins or ends beside the cloth reaches its border. Drag on the background to turn it, with
        the right button to move it; the wheel brings it nearer. Every line stays in the list and can be
        changed; a chosen one is dragged by its dots. When they are drawn,
        <b>Drape</b> lets the cloth come to rest and holds its lines, and <b>Picture</b> takes one of it;{" "}
        <b>Keep</b>, before a drape, tries each line in gusts; <b>Play</b> lets the cloth move until you pause
        it (pull at it meanwhile). Then you can draw more. Each step can be undone, and is kept on disk.
      </p>
      <table>
        <tbody>
          {keys.map(([key, what]) => (
            <tr key={key}>
              <td>
                <kbd>{key}</kbd>
              </td>
              <td>{what}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <form method="dialog">
        <button class="main">Close</button>
      </form>
    </dialog>
  );
}
