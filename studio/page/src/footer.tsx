// SPDX-License-Identifier: GPL-3.0-or-later
// Below the picture: what the program says, and how far it has come.
import { useRef } from "preact/hooks";
import { isIdle, mayDraw, type Page } from "./page";
import type { Progress } from "./protocol";
import type { Studio } from "./studio";

/** How long what is told will take, by how long it took so far; nothing while that is a guess. */
function Left({ progress }: { progress: Progress }) {
  const begun = useRef({ what: "", at: 0 });
  if (begun.current.what !== progress.what) begun.current = { what: progress.what, at: performance.now() };
  const took = (performance.now() - begun.current.at) / 1000,
    left = (took * (1 - progress.share)) / progress.share;
  if (progress.share < 0.15 || took < 3) return null;
  return (
    <>
      , about {left < 90 ? `${Math.max(1, Math.round(left))} s` : `${Math.round(left / 60)} min`} left of it
    </>
  );
}

export function Footer({ page, studio }: { page: Page; studio?: Studio }) {
  const state = page.now(),
    { status, words, gone, lost, busy, progress, dragging, frames } = state;
  return (
    <footer
      data-dragging={dragging}
      data-step={status?.step}
      data-frames={frames}
      data-lines={status?.lines.length}
    >
      <div class={words.bad ? "say bad" : "say"} role={words.bad ? "alert" : "status"}>
        {gone ? "The program has ended. Every step is kept: start furrow studio again to go on." : words.text}
      </div>
      {words.folder && <button onClick={() => void studio?.openFolder(words.folder!)}>Open folder</button>}
      {words.link && (
        <a href={words.link} target="_blank">
          Open it
        </a>
      )}
      {lost && isIdle(state) && status?.undo === "drape" && (
        <button class="main" onClick={() => void studio?.keepInstead()}>
          Undo and keep its lines
        </button>
      )}
      {status && !mayDraw(state) && !gone && (
        <button class="main" onClick={() => void studio?.ask("take")}>
          Take the pen
        </button>
      )}
      {(busy === "drape" || busy === "keep" || progress) && (
        <>
          <span>
            {progress?.what}
            {progress && <Left progress={progress} />}
          </span>
          <progress max={1} value={progress?.share} aria-label={progress?.what ?? "working"} />
          <button onClick={() => void studio?.program.ask("cancel")}>Cancel</button>
        </>
      )}
    </footer>
  );
}
