// SPDX-License-Identifier: GPL-3.0-or-later
// The page as a whole. Its state is in page.ts, what it does in studio.ts.
import { useEffect, useRef } from "preact/hooks";
import { Cloth } from "./cloth";
import { Footer } from "./footer";
import { GiveAway } from "./give";
import { Help } from "./help";
import { History } from "./history";
import { pressKey } from "./keys";
import { Lines, ownWidth } from "./lines";
import { Open, sorted } from "./open";
import { mayDraw, type Page, usePage } from "./page";
import { OverPicture } from "./picture";
import { Studio } from "./studio";
import { Toolbar } from "./toolbar";

/** Files that are dropped on the page are offered to be opened. */
function takeDroppedFiles(page: Page) {
  addEventListener("dragover", (e) => e.preventDefault());
  addEventListener("drop", (e) => {
    e.preventDefault();
    const files = sorted([...(e.dataTransfer?.files ?? [])]);
    if (!files.garment) return page.set({ badFile: "Drop a mesh: an .obj, .ply, .off, .stl, .glb or .vrm." });
    page.set({ badFile: "", files, opening: page.now().opening || "again" });
  });
}

/** The picture follows the state. */
function useShown(page: Page, studio?: Studio) {
  const { status, chosen, tool, busy, both, middle, frames, seen, verdict } = page.now(),
    line = status?.lines[chosen];
  // The dots of the chosen line.
  useEffect(() => {
    if (!line || !line.on) return studio?.handles.take([], false);
    const take = (points: [number, number, number][]) => studio?.handles.take(points, !!line.closed);
    studio?.program.ask("points", { line: chosen }).then(
      (done) => take(done.points ?? []),
      () => studio.handles.take([], false),
    );
  }, [studio, status?.step, chosen, line?.on]);
  useEffect(() => studio?.handles.show(), [studio, tool, busy]);
  useEffect(() => {
    studio?.pen.follow();
    studio?.touch.follow();
  }, [studio, tool, busy, frames]);
  useEffect(
    () => studio?.view.showPlane(both && status ? (middle ?? status.middle) : null),
    [both, middle, status?.middle, frames],
  );
  // The list of lines that the picture shows is not the whole list: some may be switched off.
  useEffect(() => {
    if (!status) return;
    studio?.view.marks.mark(
      status.shown.map((i) => {
        const { height = 0.01, width = ownWidth(height) } = status.lines[i];
        return { sign: Math.sign(height), width };
      }),
      tool === "look" ? status.shown.indexOf(chosen) : -1,
    );
    if (chosen >= status.lines.length) page.set({ chosen: -1 });
  }, [status, chosen, tool]);
  useEffect(
    () => studio?.view.marks.judge((verdict?.step === status?.step && verdict?.done.verdicts) || []),
    [verdict, status?.step],
  );
  useEffect(() => studio?.view.see(seen), [studio, seen]);
}

function Panels({ page, studio }: { page: Page; studio: Studio }) {
  const state = page.now(),
    { status, chosen, busy, map, moving, speed, verdict, frames } = state;
  return (
    <aside>
      <section aria-label="Lines">
        <h2>Lines</h2>
        {status && status.earlier.length > 0 && (
          <p class="note">In the cloth by now: {status.earlier.join(", ")}. To change them, undo.</p>
        )}
        {status && (
          <Lines
            lines={status.lines}
            again={status.earlier.length > 0}
            chosen={chosen}
            actions={studio.lines}
          />
        )}
      </section>
      {status && (
        <>
          <Cloth
            status={status}
            busy={busy}
            mayDraw={mayDraw(state)}
            map={map}
            moving={moving}
            speed={speed}
            kept={verdict?.step === status.step ? verdict.done : undefined}
            actions={studio.cloth}
          />
          <History
            status={status}
            told={frames}
            ask={() => studio.program.ask("history")}
            go={(steps) => void studio.goBack(steps)}
          />
          <GiveAway page={page} studio={studio} />
        </>
      )}
    </aside>
  );
}

export function App({ token }: { token: string }) {
  const canvas = useRef<HTMLCanvasElement>(null),
    page = usePage(),
    begun = useRef<Studio>();
  const studio = begun.current,
    { tool, busy, help, opening, items, files, badFile } = page.now();
  useEffect(() => {
    const made = (begun.current = new Studio(page, canvas.current!, token));
    addEventListener("keydown", (e) => pressKey(e, page, made));
    takeDroppedFiles(page);
    page.set({}); // the parts have it now
  }, []);
  useShown(page, studio);
  return (
    <>
      <Toolbar page={page} studio={studio} />
      <main class={tool !== "look" ? "pen" : busy === "play" ? "hand" : ""}>
        <canvas
          ref={canvas}
          tabIndex={0}
          aria-label="The cloth. Arrow keys turn it, plus and minus bring it nearer."
        />
        <OverPicture page={page} studio={studio} />
      </main>
      {studio ? <Panels page={page} studio={studio} /> : <aside />}
      <Footer page={page} studio={studio} />
      {help && <Help close={() => page.set({ help: false })} />}
      {opening && studio && (
        <Open
          items={items}
          first={opening === "first"}
          files={files}
          bad={badFile}
          open={(words) => studio.open(words)}
          close={() => page.set({ opening: "" })}
        />
      )}
    </>
  );
}
