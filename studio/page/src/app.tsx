// SPDX-License-Identifier: GPL-3.0-or-later
import { useEffect, useRef, useState } from "preact/hooks";
import { readFrame, Kind } from "./frame";
import { Help } from "./help";
import { type LineActions, Lines, mm, ownWidth, Slider } from "./lines";
import { Pen } from "./pen";
import { type Done, Program, type Progress, type Status } from "./protocol";
import { type Seen, View } from "./view";

type Tool = "look" | "ridge" | "valley";
interface Words { text: string; bad: boolean }
interface Draft { height: number; width: number | null }

/** What lives as long as the page and is no state of a panel. */
interface Parts { program: Program; view: View; pen: Pen }

export function App({ token }: { token: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const parts = useRef<Parts>();
  const [status, setStatus] = useState<Status>();
  const [me, setMe] = useState(0);
  const [tool, setTool] = useState<Tool>("look");
  const [draft, setDraft] = useState<Draft>({ height: 0.03, width: null });
  const [chosen, setChosen] = useState(-1);
  const [seen, setSeen] = useState<Seen>({ body: true, wire: false, lines: true });
  const [words, setWords] = useState<Words>({ text: "", bad: false });
  const [progress, setProgress] = useState<Progress>();
  const [busy, setBusy] = useState<"" | "drape" | "play">("");
  const [moving, setMoving] = useState(0);
  const [fit, setFit] = useState<"" | "strain" | "distance">("");
  const [frames, setFrames] = useState(0);
  const [gone, setGone] = useState(false);
  const [help, setHelp] = useState(false);
  const now = useRef({ tool, draft, chosen, status, seen, me, busy });
  now.current = { tool, draft, chosen, status, seen, me, busy };
  const live = useRef({ running: false, waiting: null as null | (() => void) });

  const say = (text: string, bad = false) => setWords({ text, bad });
  /** Asks the program; what it says against it is shown in its words. */
  const ask = async (what: string, body: object = {}, then?: (done: Done) => string) => {
    if (now.current.busy === "play") void parts.current!.program.ask("pause");  // what is asked then wants it still
    try {
      const done = await parts.current!.program.ask(what, body);
      say([then?.(done) ?? "", ...(done.told ?? []).map((t) => `Note: ${t}`)].filter(Boolean).join("\n"));
      return true;
    } catch (e) {
      say((e as Error).message, true);
      return false;
    }
  };

  useEffect(() => {
    const view = new View(canvas.current!);
    const program = new Program(token, {
      status: setStatus, you: setMe, gone: () => setGone(true),
      progress: (p) => setProgress(p.share < 1 ? p : undefined),
      frame: (bytes) => {
        const frame = readFrame(bytes);
        if ("time" in frame) {
          view.move(frame.positions);
          setMoving(frame.time);
          setFit("");
          return;
        }
        if ("colours" in frame) return view.colour(frame.colours);
        view.show(frame);
        setFit("");
        if (frame.kind !== Kind.body && !pen.drawing) view.showBand([], 0, 0);
        setFrames((n) => n + 1);
      },
    });
    const settings = () => {
      const { tool, draft, busy } = now.current;
      return { on: tool !== "look" && !busy, colour: tool === "valley" ? view.colours.valley : view.colours.ridge, width: draft.width ?? ownWidth(draft.height) };
    };
    const pen = new Pen(view, settings, {
      drawn: async ({ points, closed }) => {
        const { tool, draft } = now.current;
        const height = tool === "valley" ? -draft.height : draft.height;
        const line = { height, points, closed, ...(draft.width === null ? {} : { width: draft.width }) };
        if (await ask("draw", line)) setChosen(now.current.status!.lines.length - 1);  // its sliders are open
        else pen.drop();
      },
      tooShort: () => say("That was too short for a line: hold the button down and draw over the cloth."),
    });
    parts.current = { program, view, pen };
  }, []);

  // The list of lines that the picture shows is not the whole list: some may be switched off.
  useEffect(() => {
    if (!status) return;
    parts.current?.view.mark(status.shown.map((i) => Math.sign(status.lines[i].height ?? 1)), status.shown.indexOf(chosen));
    if (chosen >= status.lines.length) setChosen(-1);
  }, [status, chosen]);
  useEffect(() => parts.current?.view.see(seen), [seen]);

  const actions: LineActions = {
    choose: setChosen,
    set: (line, change, isLive) => {
      if (!isLive) {
        live.current.waiting = null;
        void ask("set", { line, ...change });
        return;
      }
      const send = async () => {
        live.current.running = true;
        live.current.waiting = null;
        await ask("set", { line, ...change, live: true });
        live.current.running = false;
        (live.current as { waiting: null | (() => void) }).waiting?.();
      };
      if (live.current.running) live.current.waiting = send;
      else void send();
    },
    remove: (line) => void ask("delete", { line }),
    mirror: async (line) => {
      if (await ask("mirror", { line })) setChosen(now.current.status!.lines.length - 1);
    },
  };
  const drape = async () => {
    if (busy) return;
    setBusy("drape");
    say("The cloth comes to rest …");
    await ask("drape", {}, (done) => [done.outcome === "at rest" ? "The cloth is at rest. Draw more, or undo." : `Outcome: ${done.outcome}.`,
      ...(done.remarks ?? [])].join("\n"));
    setBusy("");
    setProgress(undefined);
  };
  const pause = () => void parts.current!.program.ask("pause");
  /** Moves the cloth until it is paused, or takes one step. */
  const play = async (seconds?: number) => {
    if (busy === "play") return pause();
    if (busy || !status?.can_drape || !mayDraw) return;
    setBusy("play");
    setMoving(status.time);
    say("");
    await ask("play", seconds ? { seconds } : {}, (done) => [`It has moved for ${done.time!.toFixed(2)} s. Draw more, go on, or undo.`,
      ...(done.remarks ?? [])].join("\n"));
    setBusy("");
  };
  /** Shows strain, or the distance to the body, or the cloth's own colour again. */
  const showFit = async (by: "strain" | "distance") => {
    if (fit === by) {
      setFit("");
      return parts.current!.view.colour(null);
    }
    if (await ask("fit", { by }, (done) => `${done.words}\n${done.legend}`)) setFit(by);
  };
  const undo = () => void ask("undo");
  const redo = () => void ask("redo");
  const save = () => void ask("save", {}, (done) => `Saved in ${status?.title}: ${(done.written ?? []).join(", ")}.`);
  const toggle = (key: keyof Seen) => setSeen((s) => ({ ...s, [key]: !s[key] }));
  const pick = (t: Tool) => {
    if (t !== "look" && busy === "play") pause();  // who picks up a pen wants the cloth to hold still
    setTool((old) => (old === t ? "look" : t));
  };
  const mayDraw = status ? status.pen === me || status.pen === 0 : false;

  useEffect(() => {
    const press = (e: KeyboardEvent) => {
      const at = e.target as HTMLElement, view = parts.current!.view;
      if (at.closest("dialog") || (at instanceof HTMLInputElement && at.type === "text")) return;
      const key = e.key.toLowerCase(), { chosen } = now.current;
      const act = (work: () => void) => { e.preventDefault(); work(); };
      if (e.ctrlKey || e.metaKey) {
        if (key === "z") act(e.shiftKey ? redo : undo);
        else if (key === "y") act(redo);
        else if (key === "s") act(save);
        return;
      }
      if (e.altKey) return;
      const plain: Record<string, () => void> = {
        r: () => pick("ridge"), v: () => pick("valley"), f: () => view.look(), "1": () => view.look("front"), "2": () => view.look("back"),
        "3": () => view.look("right"), b: () => toggle("body"), w: () => toggle("wire"), l: () => toggle("lines"), d: () => void drape(),
        "?": () => setHelp(true), " ": () => void play(), escape: () => (parts.current!.pen.drawing ? parts.current!.pen.drop() : setTool("look")),
      };
      if (chosen >= 0) Object.assign(plain, { delete: () => actions.remove(chosen), m: () => actions.mirror(chosen) });
      if (at === canvas.current)
        Object.assign(plain, {
          arrowleft: () => view.turn(-0.12, 0), arrowright: () => view.turn(0.12, 0), arrowup: () => view.turn(0, 0.12),
          arrowdown: () => view.turn(0, -0.12), "+": () => view.turn(0, 0, 1.15), "-": () => view.turn(0, 0, 1 / 1.15),
        });
      if (key === " " && at.closest("button, input")) return;  // which a space presses
      if (plain[key] && !(at instanceof HTMLSelectElement)) act(plain[key]);
    };
    addEventListener("keydown", press);
    return () => removeEventListener("keydown", press);
  });

  const hint = !status ? "Opening …" : tool !== "look" ? `Draw on the cloth. Drag beside it to turn it. Shift: straight. Esc: lay the pen down.`
    : status.lines.length === 0 && status.step === 0 ? "Pick Ridge or Valley above, then draw on the cloth. Drag to turn it." : "";

  return (
    <>
      <header>
        <h1 title={status?.title}>{status?.title ?? "Furrow studio"}</h1>
        <div class="group" role="group" aria-label="Pen">
          {([["look", "Look", "Esc"], ["ridge", "Ridge", "R"], ["valley", "Valley", "V"]] as const).map(([t, label, key]) => (
            <button key={t} aria-pressed={tool === t} title={`${label} (${key})`} onClick={() => pick(t)}>{label}</button>
          ))}
        </div>
        <div class="group">
          <Slider label="Height" value={draft.height * 1000} min={2} max={100} step={1} text={mm(draft.height)}
            change={(v) => setDraft((d) => ({ ...d, height: v / 1000 }))} />
        </div>
        <div class="group">
          <Slider label="Width" value={(draft.width ?? ownWidth(draft.height)) * 1000} min={10} max={300} step={5}
            text={draft.width === null ? "auto" : mm(draft.width)} change={(v) => setDraft((d) => ({ ...d, width: v / 1000 }))} />
          {draft.width !== null && <button class="small" onClick={() => setDraft((d) => ({ ...d, width: null }))}>auto</button>}
        </div>
        <div class="group">
          <button disabled={!status?.undo} title={status?.undo ? `Undo: ${status.undo} (Ctrl Z)` : "Nothing to undo"} onClick={undo}>Undo</button>
          <button disabled={!status?.redo} title={status?.redo ? `Do again: ${status.redo} (Ctrl Y)` : "Nothing to do again"} onClick={redo}>Redo</button>
          <button title="Save (Ctrl S)" onClick={save}>Save</button>
          <button title="Keys (?)" aria-label="Help" onClick={() => setHelp(true)}>?</button>
        </div>
      </header>
      <main class={tool === "look" ? "" : "pen"}>
        <canvas ref={canvas} tabIndex={0} aria-label="The cloth. Arrow keys turn it, plus and minus bring it nearer." />
        {hint && <div class="hint" role="status">{hint}</div>}
        <div class="views" role="group" aria-label="View">
          <button class="small" title="Frame (F)" onClick={() => parts.current!.view.look()}>Frame</button>
          <button class="small" title="Front (1)" onClick={() => parts.current!.view.look("front")}>Front</button>
          <button class="small" title="Back (2)" onClick={() => parts.current!.view.look("back")}>Back</button>
          <button class="small" title="Side (3)" onClick={() => parts.current!.view.look("right")}>Side</button>
          {status?.has_body && <button class="small" aria-pressed={seen.body} title="Body (B)" onClick={() => toggle("body")}>Body</button>}
          <button class="small" aria-pressed={seen.lines} title="Lines (L)" onClick={() => toggle("lines")}>Lines</button>
          <button class="small" aria-pressed={seen.wire} title="Wireframe (W)" onClick={() => toggle("wire")}>Wire</button>
        </div>
      </main>
      <aside>
        <section aria-label="Lines">
          <h2>Lines</h2>
          {status && status.earlier.length > 0 &&
            <p class="note">In the cloth since it moved: {status.earlier.join(", ")}. To change them, undo.</p>}
          {status && <Lines lines={status.lines} again={status.earlier.length > 0} chosen={chosen} actions={actions} />}
        </section>
        {status && <section class="cloth" aria-label="Cloth">
          <h2>Cloth</h2>
          <label>Fabric
            <select value={status.fabric} onChange={(e) => void ask("fabric", { name: e.currentTarget.value })}>
              {status.fabrics.map((f) => <option key={f}>{f}</option>)}
            </select>
          </label>
          {(status.holds_top || status.pins === 0) && <label class="check">
            <input type="checkbox" checked={status.holds_top} onChange={(e) => void ask("hold", { on: e.currentTarget.checked })} />
            Hold the upper border
          </label>}
          <div class="group">
            <button class="main" disabled={!status.can_drape || busy !== "" || !mayDraw} title="Drape (D)" onClick={() => void drape()}>Drape</button>
            <button disabled={!status.can_drape || busy === "drape" || !mayDraw} title="Play, pause (Space)" onClick={() => void play()}>
              {busy === "play" ? "Pause" : "Play"}</button>
            <button disabled={!status.can_drape || busy !== "" || !mayDraw} title="One step of 1/60 s" onClick={() => void play(1 / 60)}>Step</button>
          </div>
          {(busy === "play" || status.time > 0) && <p class="note" data-time={moving}>At {(busy === "play" ? moving : status.time).toFixed(2)} s of its motion.</p>}
          {status.has_body && <div class="group" role="group" aria-label="Fit">
            <span>Fit</span>
            {(["strain", "distance"] as const).map((by) => (
              <button key={by} aria-pressed={fit === by} disabled={busy !== "" || !mayDraw} onClick={() => void showFit(by)}>
                {by === "strain" ? "Strain" : "Distance"}</button>
            ))}
          </div>}
          <p class="note">{status.can_drape ? "Drape lets the cloth come to rest under its weight; Play lets it move." : "To drape it, hold its upper border, or open it with --body."}</p>
        </section>}
      </aside>
      <footer data-step={status?.step} data-frames={frames} data-lines={status?.lines.length}>
        <div class={words.bad ? "say bad" : "say"} role={words.bad ? "alert" : "status"}>
          {gone ? "The program has ended. Every step is kept: start furrow studio again to go on." : words.text}
        </div>
        {!mayDraw && status && !gone && <button class="main" onClick={() => void ask("take")}>Take the pen</button>}
        {(busy === "drape" || progress) && <>
          <span>{progress?.what}</span>
          <progress max={1} value={progress?.share} aria-label={progress?.what ?? "working"} />
          <button onClick={() => void parts.current!.program.ask("cancel")}>Cancel</button>
        </>}
      </footer>
      {help && <Help close={() => setHelp(false)} />}
    </>
  );
}
