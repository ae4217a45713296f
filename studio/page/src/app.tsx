// SPDX-License-Identifier: GPL-3.0-or-later
import { useEffect, useRef, useState } from "preact/hooks";
import { Vector3 } from "three";
import { Cloth, type ClothActions, type ClothMap } from "./cloth";
import { readFrame, Kind } from "./frame";
import { Hand } from "./hand";
import { Handles } from "./handles";
import { Help } from "./help";
import { History } from "./history";
import { type LineActions, type LineChange, Lines, mm, ownWidth, Slider } from "./lines";
import { type Files, Open, type OpenWords, sorted } from "./open";
import { Pen } from "./pen";
import { type Done, type GalleryItem, type Line, Program, type Progress, type Status, type Vector } from "./protocol";
import { type Seen, View } from "./view";

type Tool = "look" | "ridge" | "valley" | "pin";
interface Words { text: string; bad: boolean }
interface Draft { height: number; width: number | null }

/** What lives as long as the page and is no state of a panel. */
interface Parts { program: Program; view: View; pen: Pen; handles: Handles; hand: Hand }
type Busy = "" | "drape" | "keep" | "give" | "play";
/** What a first start is told, one thing after the other. */
const hints: [(s: Status) => boolean, string][] = [
  [(s) => s.lines.length === 0 && s.step === 0, "Pick Ridge or Valley above, then draw on the cloth. Drag to turn it."],
  [(s) => s.step === 1 && s.lines.length > 0, "Its height, width and sharpness are on the right; choose it, and drag it by its dots. Draw more."],
  [(s) => s.step <= 12 && s.lines.some((l) => l.on) && s.can_drape, "When all lines are drawn: Keep (K) makes them last, then Drape (D) lets the cloth come to rest. Undo takes anything back."],
  [(s) => s.undo === "keep" && s.step <= 13, "Now press Drape (D): the cloth comes to rest with its folds."],
  [(s) => s.undo === "drape" && s.step <= 14, "Picture, below on the right, takes one. Draw more, or Play (Space); ? shows all keys."],
];
/** What a job says of options of the command line, in words that the page has. */
const inPage = (text: string) => text.replace(/; cloth has no contact with cloth here: .*/g, "; Tangles (T) shows where, Undo takes it back").replace(/; --[a-z-]+[^;.\n]*/g, "").replace(/furrow keep/g, "Keep").replace(/furrow drape/g, "Drape");
/** A line with a change that is not answered yet; several at once keep their signs. */
const changed = (line: Line, { points, width, height, ...more }: LineChange, isOneOfSeveral: boolean): Line => ({
  ...line, ...more, ...(width !== undefined && { width: width ?? undefined }),
  ...(height !== undefined && { height: isOneOfSeveral && (line.height ?? 1) < 0 ? -height : height, varies: false }),
});
const isPen = (tool: Tool) => tool === "ridge" || tool === "valley";

/** How long what is told will take, by how long it took so far; nothing while that is a guess. */
function Left({ progress }: { progress: Progress }) {
  const begun = useRef({ what: "", at: 0 });
  if (begun.current.what !== progress.what) begun.current = { what: progress.what, at: performance.now() };
  const took = (performance.now() - begun.current.at) / 1000, left = (took * (1 - progress.share)) / progress.share;
  return progress.share < 0.15 || took < 3 ? null : <>, about {left < 90 ? `${Math.max(1, Math.round(left))} s` : `${Math.round(left / 60)} min`} left of it</>;
}

export function App({ token }: { token: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const parts = useRef<Parts>();
  const [status, setStatus] = useState<Status>();
  const [me, setMe] = useState(0);
  const [tool, setTool] = useState<Tool>("look");
  const [draft, setDraft] = useState<Draft>({ height: 0.02, width: null });
  const [chosen, setChosen] = useState(-1);
  const [seen, setSeen] = useState<Seen>({ body: true, wire: false, lines: true });
  const [words, setWords] = useState<Words>({ text: "", bad: false });
  const [progress, setProgress] = useState<Progress>();
  const [busy, setBusy] = useState<Busy>("");
  const [both, setBoth] = useState(false);  // what is drawn is mirrored
  const [middle, setMiddle] = useState<number | null>(null);  // while it is dragged
  const [verdict, setVerdict] = useState<{ step: number; done: Done }>();  // of the shape that the step made
  const [tangles, setTangles] = useState(false);
  const [dragging, setDragging] = useState(false);  // a line, by its dots
  const [moving, setMoving] = useState(0);
  const [speed, setSpeed] = useState(1);  // of a play, over the clock's
  const [lost, setLost] = useState(false);  // what was draped has lost lines
  const [map, setMap] = useState<"" | ClothMap>("");  // that the cloth's colours show
  const [frames, setFrames] = useState(0);
  const [gone, setGone] = useState(false);
  const [help, setHelp] = useState(false);
  const [items, setItems] = useState<GalleryItem[]>([]);
  const [opening, setOpening] = useState<"" | "first" | "again">("");
  const [files, setFiles] = useState<Files>({ garment: null, body: null, madeFor: null });
  const [badFile, setBadFile] = useState("");
  const now = useRef({ tool, draft, chosen, status, seen, me, busy, both, speed });
  now.current = { tool, draft, chosen, status, seen, me, busy, both, speed };
  const live = useRef({ running: false, waiting: null as null | (() => void) });

  const say = (text: string, bad = false) => setWords({ text, bad });
  /** Asks the program; what it says against it is shown in its words. */
  const ask = async (what: string, body: object = {}, then?: (done: Done) => string) => {
    if (now.current.busy === "play") void parts.current!.program.ask("pause");  // what is asked then wants it still
    try {
      const done = await parts.current!.program.ask(what, body);
      say([then?.(done) ?? "", ...(done.told ?? []).map((t) => `Note: ${t}`)].map(inPage).filter(Boolean).join("\n"));
      return true;
    } catch (e) {
      const why = (e as Error).message;
      say(why, !why.startsWith("stopped;"));  // which was asked for
      return false;
    }
  };

  useEffect(() => {
    const view = new View(canvas.current!);
    const program = new Program(token, {
      status: setStatus, you: setMe, gone: () => setGone(true),
      gallery: (all, open) => {
        setItems(all);
        if (!open) setOpening("first");
      },
      opened: () => {
        view.forget();
        setChosen(-1);
        setVerdict(undefined);
        setTool("look");
        setWords({ text: "", bad: false });
        setOpening("");
      },
      progress: (p) => setProgress(p.share < 1 ? p : undefined),
      frame: (bytes) => {
        const frame = readFrame(bytes);
        if ("time" in frame) {
          if (frame.kind === Kind.movingBody) return view.moveBody(frame.positions);
          view.move(frame.positions);
          hand.follow();
          setMoving(frame.time);
          setMap("");
          return;
        }
        if ("colours" in frame) return view.colour(frame.colours);
        view.show(frame);
        if (frame.kind !== Kind.body) handles.show();
        if (frame.kind === Kind.cloth) {
          setMap("");
          setTangles(false);
        }
        if (frame.kind !== Kind.body && !pen.drawing) view.showBand([], 0, 0);
        setFrames((n) => n + 1);
      },
    });
    const settings = () => {
      const { tool, draft, busy } = now.current;
      return { on: isPen(tool) && !busy, colour: tool === "valley" ? view.colours.valley : view.colours.ridge, width: draft.width ?? ownWidth(draft.height) };
    };
    const pen = new Pen(view, settings, {
      drawn: async ({ points, closed, pressure = 0.5 }) => {
        const { tool, draft, both, status } = now.current, place = status!.lines.length;
        const size = draft.height * Math.min(2, Math.max(0.2, 2 * pressure)), height = tool === "valley" ? -size : size;
        const line = { height, points, closed, ...(draft.width === null ? {} : { width: draft.width }), ...(both ? { mirror: true } : {}) };
        if (await ask("draw", line)) setChosen(place);  // its sliders are open
        else pen.drop();
      },
      tooShort: () => say("That was too short for a line: hold the button down and draw over the cloth."),
    });
    const canDrag = () => {
      const { tool, busy, chosen, status } = now.current;
      return tool === "look" && !busy && chosen >= 0 && !!status?.lines[chosen]?.on && mayDrawNow();
    };
    const handles = new Handles(view, canDrag, {
      moved: (points, isLive) => {
        setDragging(isLive);
        actions.set(now.current.chosen, { points }, isLive);
      },
      dropped: () => {
        setDragging(false);
        live.current.waiting = null;
        void program.ask("show");
      },
    });
    const hand = new Hand(view, () => (!mayDrawNow() ? "" : now.current.busy === "play" ? "pull" : now.current.tool === "pin" && !now.current.busy ? "pin" : ""), {
      // What the program does not want to hear any more, as the cloth has just been paused, is no fault.
      pulls: (grip) => void program.ask("pull", grip ?? {}).catch(() => undefined),
      pins: (at, border) => void (border ? ask("hold", { at }) : ask("pin", { at })),
      encircles: (vertices, on) => (vertices.length ? void ask("pin", { vertices, on }) : say("There is no vertex of the cloth within that loop: draw it larger, or click.")),
    });
    parts.current = { program, view, pen, handles, hand };
  }, []);
  const mayDrawNow = () => {
    const { status, me } = now.current;
    return !!status && (status.pen === me || status.pen === 0);
  };

  // The dots of the chosen line.
  useEffect(() => {
    const { program, handles } = parts.current!, line = status?.lines[chosen];
    if (!line || !line.on) return handles.take([], false);
    program.ask("points", { line: chosen }).then((done) => handles.take(done.points ?? [], !!line.closed), () => handles.take([], false));
  }, [status?.step, chosen, status?.lines[chosen]?.on]);
  useEffect(() => parts.current!.handles.show(), [tool, busy]);
  useEffect(() => parts.current!.view.showPlane(both && status ? (middle ?? status.middle) : null), [both, middle, status?.middle, frames]);

  // The list of lines that the picture shows is not the whole list: some may be switched off.
  useEffect(() => {
    if (!status) return;
    parts.current?.view.mark(status.shown.map((i) => Math.sign(status.lines[i].height ?? 1)), status.shown.indexOf(chosen));
    if (chosen >= status.lines.length) setChosen(-1);
  }, [status, chosen]);
  useEffect(() => parts.current?.view.see(seen), [seen]);

  const actions: LineActions = {
    choose: setChosen,
    set: (lines, change, isLive) => {
      const meant = Array.isArray(lines) ? { lines } : { line: lines };
      if (!isLive) {
        live.current.waiting = null;
        // The panel has it at once: what is pressed next goes on from there.
        setStatus((s) => s && { ...s, lines: s.lines.map((l, i) => ([lines].flat().includes(i) ? changed(l, change, Array.isArray(lines)) : l)) });
        // What is refused leaves no preview behind.
        void ask("set", { ...meant, ...change }).then((is) => void (is || parts.current!.program.ask("show")));
        return;
      }
      const send = async () => {
        live.current.running = true;
        live.current.waiting = null;
        await ask("set", { ...meant, ...change, live: true });
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
    duplicate: async (line) => {
      if (await ask("duplicate", { line })) setChosen(now.current.status!.lines.length - 1);
    },
    move: async (line, to) => {
      if (to >= 0 && to < now.current.status!.lines.length && (await ask("move", { line, to }))) setChosen(to);
    },
  };
  const drape = async () => {
    if (busy) return;
    setBusy("drape");
    setLost(false);
    say("The cloth comes to rest …");
    await ask("drape", {}, (done) => {
      setLost(done.lost ?? false);
      return [done.outcome === "at rest" ? "The cloth is at rest. Draw more, or undo." : `Outcome: ${done.outcome}.`, ...(done.remarks ?? [])].join("\n");
    });
    setBusy("");
    setProgress(undefined);
  };
  const keep = async () => {
    if (busy) return;
    setBusy("keep");
    say("The lines are tried: each has to hold, at rest and in a gust. That takes minutes on a large garment, and can be stopped.");
    await ask("keep", {}, (done) => {
      setVerdict({ step: now.current.status!.step, done });
      return [done.all_hold ? "Every line holds." : "Not every line is sure to hold; the list says why.", ...(done.remarks ?? [])].join("\n");
    });
    setBusy("");
    setProgress(undefined);
  };
  /** Back to where the lines were drawn, and they are made to last there. */
  const keepInstead = async () => {
    setLost(false);
    if (await ask("undo")) await keep();
  };
  const showTangles = async () => {
    if (tangles) {
      setTangles(false);
      return parts.current!.view.colour(null);
    }
    await ask("tangles", {}, (done) => {
      setTangles(done.pairs! > 0);
      setMap("");
      if (done.at) parts.current!.view.lookAt(new Vector3(...done.at));
      return done.words!;
    });
  };
  const pause = () => void parts.current!.program.ask("pause");
  /** Moves the cloth until it is paused, or takes one step. */
  const play = async (seconds?: number) => {
    if (busy === "play") return pause();
    if (busy || !status?.can_drape || !mayDraw) return;
    setBusy("play");
    setTool((t) => (isPen(t) ? "look" : t));  // the pointer pulls now
    setMoving(status.time);
    say("");
    await ask("play", seconds ? { seconds } : { speed: now.current.speed }, (done) => [`It has moved for ${done.time!.toFixed(2)} s. Draw more, go on, or undo.`,
      ...(done.remarks ?? [])].join("\n"));
    setBusy("");
  };
  /** Shows strain, the distance to the body, or mass, or the cloth's own colour again. */
  const showMap = async (of: ClothMap) => {
    if (map === of) {
      setMap("");
      return parts.current!.view.colour(null);
    }
    if (await ask(of === "mass" ? "weigh" : "fit", { by: of }, (done) => `${done.words}\n${done.legend}`)) setMap(of);
  };
  /** In a wind that changes while the cloth moves, it moves on. */
  const blow = async (velocity: Vector) => {
    const goesOn = now.current.busy === "play";
    if ((await ask("wind", { velocity })) && goesOn) again.current = true;
  };
  const again = useRef(false);
  useEffect(() => {
    if (busy || !again.current) return;
    again.current = false;
    void play();
  });
  const undo = () => {
    const what = now.current.status?.undo;
    setLost(false);
    void ask("undo", {}, () => `Undone: ${what}.`);
  };
  /** So many steps back, or on where that is negative. */
  const goBack = async (steps: number) => {
    setLost(false);
    for (let i = 0; i < Math.abs(steps); ++i) if (!(await ask(steps > 0 ? "undo" : "redo"))) return;
  };
  const redo = () => {
    const what = now.current.status?.redo;
    void ask("redo", {}, () => `Done again: ${what}.`);
  };
  const save = () => void ask("save", {}, (done) => `Saved in ${status?.title}: ${(done.written ?? []).join(", ")}.`);
  const give = async (as: string) => {
    setBusy("give");
    await ask("give", { as }, (done) => `Written: ${done.file}`);
    setBusy("");
    setProgress(undefined);
  };
  const open = async ({ item, files, unit, up }: OpenWords) => {
    const program = parts.current!.program;
    setBadFile("");
    try {
      const sent = async (file?: File | null) => file && (await program.upload(file));
      const garment = await sent(files?.garment), body = await sent(files?.body), made_for = await sent(files?.madeFor);
      const chosen = { garment, ...(body && { body }), ...(made_for && { made_for }), ...(unit && { unit }), ...(up && { up }) };
      const done = await program.ask("open", item ? { item } : chosen);
      say([`Every step is kept in ${done.project}.`, ...(done.told ?? [])].join("\n"));
      setFiles({ garment: null, body: null, madeFor: null });
    } catch (e) {
      setBadFile((e as Error).message);
    }
  };
  useEffect(() => {
    const over = (e: DragEvent) => e.preventDefault();
    const drop = (e: DragEvent) => {
      e.preventDefault();
      const dropped = sorted([...(e.dataTransfer?.files ?? [])]);
      if (!dropped.garment) return setBadFile("Drop a mesh: an .obj, .ply, .off, .stl or .glb.");
      setBadFile("");
      setFiles(dropped);
      setOpening((o) => o || "again");
    };
    addEventListener("dragover", over);
    addEventListener("drop", drop);
    return () => {
      removeEventListener("dragover", over);
      removeEventListener("drop", drop);
    };
  }, []);
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
        else if (key === "d" && chosen >= 0) act(() => actions.duplicate(chosen));
        return;
      }
      if (e.altKey && chosen >= 0 && (key === "arrowup" || key === "arrowdown")) act(() => actions.move(chosen, chosen + (key === "arrowup" ? -1 : 1)));
      if (e.altKey) return;
      const plain: Record<string, () => void> = {
        r: () => pick("ridge"), v: () => pick("valley"), f: () => view.frameAll(), "1": () => view.look("front"), "2": () => view.look("back"),
        "3": () => view.look("right"), b: () => toggle("body"), w: () => toggle("wire"), l: () => toggle("lines"), d: () => void drape(),
        "?": () => setHelp(true), " ": () => void play(), escape: () => {
          const { pen, handles, hand } = parts.current!;
          if (pen.drawing) return pen.drop();
          if (hand.encircling) return hand.drop();
          if (!handles.dragging) return setTool("look");
          handles.drop();
        },
      };
      Object.assign(plain, { p: () => pick("pin"), k: () => void keep(), t: () => void showTangles(), o: () => status && !busy && mayDraw && setOpening("again") });
      if (isPen(now.current.tool)) plain.m = () => setBoth((b) => !b);
      else if (chosen >= 0) plain.m = () => actions.mirror(chosen);
      if (chosen >= 0) plain.delete = () => actions.remove(chosen);
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

  const clothActions: ClothActions = {
    fabric: (name) => void ask("fabric", { name }, () => `It is made of ${name} now; Drape or Play shows how that hangs.`), hold: (border, on) => void ask("hold", { border, on }), wind: (v) => void blow(v),
    drape: () => void drape(), keep: () => void keep(), play: (seconds) => void play(seconds), map: (of) => void showMap(of),
    accept: (drapes) => {
      setVerdict(undefined);
      parts.current!.view.colour(null);
      if (drapes) void drape();
    },
    takeBack: undo, pace: setSpeed,
  };
  const hint = !status ? (opening ? "" : "Opening …") : tool === "pin" ? "Click the cloth to hold it there, or to let it go; Shift: the whole border. Draw a loop to hold all within; Shift: to let it go. Esc: enough." : tool !== "look" ? `Draw on the cloth; begin and end beside it to reach its border. Drag on the background to turn it. Shift: straight. Esc: lay the pen down.`
    : hints.find(([fits]) => fits(status))?.[1] ?? "";

  return (
    <>
      <header>
        <h1 title={status?.title}>{status?.title ?? "Furrow studio"}</h1>
        <div class="group" role="group" aria-label="Pen">
          {([["look", "Look", "Esc"], ["ridge", "Ridge", "R"], ["valley", "Valley", "V"], ["pin", "Pin", "P"]] as const).map(([t, label, key]) => (
            <button key={t} aria-pressed={tool === t} title={`${label} (${key})`} onClick={() => pick(t)}>{label}</button>
          ))}
        </div>
        <div class="group">
          <Slider label="New height" value={draft.height * 1000} min={2} max={100} step={1} text={(v) => mm(v / 1000)}
            change={(v) => setDraft((d) => ({ ...d, height: v / 1000 }))} />
        </div>
        <div class="group">
          <Slider label="New width" value={(draft.width ?? ownWidth(draft.height)) * 1000} min={10} max={300} step={5}
            text={(v, dragged) => (draft.width === null && !dragged ? "auto" : mm(v / 1000))} change={(v) => setDraft((d) => ({ ...d, width: v / 1000 }))} />
          {draft.width !== null && <button class="small" onClick={() => setDraft((d) => ({ ...d, width: null }))}>auto</button>}
        </div>
        <div class="group">
          <button aria-pressed={both} title="Draw each line on the other side, too (M while a pen is up)" onClick={() => setBoth(!both)}>Both sides</button>
        </div>
        <div class="group">
          <button disabled={!status?.undo} title={status?.undo ? `Undo: ${status.undo} (Ctrl Z)` : "Nothing to undo"} onClick={undo}>Undo</button>
          <button disabled={!status?.redo} title={status?.redo ? `Do again: ${status.redo} (Ctrl Y)` : "Nothing to do again"} onClick={redo}>Redo</button>
          <button title="Save (Ctrl S)" disabled={!status} onClick={save}>Save</button>
          <button title="Another garment (O)" disabled={busy !== "" || !mayDraw} onClick={() => setOpening("again")}>Open</button>
          <button title="Keys (?)" aria-label="Help" onClick={() => setHelp(true)}>?</button>
        </div>
      </header>
      <main class={tool !== "look" ? "pen" : busy === "play" ? "hand" : ""}>
        <canvas ref={canvas} tabIndex={0} aria-label="The cloth. Arrow keys turn it, plus and minus bring it nearer." />
        {hint && <div class="hint" role="status">{hint}</div>}
        {both && status && <div class="middle group">
          <Slider label="Middle" value={status.middle * 1000} min={Math.round(status.middle * 1000) - 300} max={Math.round(status.middle * 1000) + 300} step={1}
            text={(v) => mm(v / 1000)} change={(v, isLive) => {
              setMiddle(isLive ? v / 1000 : null);
              if (!isLive) void ask("middle", { x: v / 1000 });
            }} />
        </div>}
        <div class="views" role="group" aria-label="View">
          <button class="small" title="The cloth; once more: with its body (F)" onClick={() => parts.current!.view.frameAll()}>Frame</button>
          <button class="small" title="Front (1)" onClick={() => parts.current!.view.look("front")}>Front</button>
          <button class="small" title="Back (2)" onClick={() => parts.current!.view.look("back")}>Back</button>
          <button class="small" title="Side (3)" onClick={() => parts.current!.view.look("right")}>Side</button>
          {status?.has_body && <button class="small" aria-pressed={seen.body} title="Body (B)" onClick={() => toggle("body")}>Body</button>}
          <button class="small" aria-pressed={seen.lines} title="Lines (L)" onClick={() => toggle("lines")}>Lines</button>
          <button class="small" aria-pressed={tangles} disabled={busy !== "" || !mayDraw} title="Where cloth crosses cloth (T)" onClick={() => void showTangles()}>Tangles</button>
          <button class="small" aria-pressed={seen.wire} title="Wireframe (W)" onClick={() => toggle("wire")}>Wire</button>
        </div>
      </main>
      <aside>
        <section aria-label="Lines">
          <h2>Lines</h2>
          {status && status.earlier.length > 0 &&
            <p class="note">In the cloth by now: {status.earlier.join(", ")}. To change them, undo.</p>}
          {status && <Lines lines={status.lines} again={status.earlier.length > 0} chosen={chosen} actions={actions} />}
        </section>
        {status && <Cloth status={status} busy={busy} mayDraw={mayDraw} map={map} moving={moving} speed={speed} kept={verdict?.step === status.step ? verdict.done : undefined} actions={clothActions} />}
        {status && <History status={status} told={frames} ask={() => parts.current!.program.ask("history")} go={(steps) => void goBack(steps)} />}
        {status && <section aria-label="Give away">
          <h2>Give away</h2>
          <div class="group wrap">
            {([["ply", "PLY", "The mesh, with all that is known of it"], ["obj", "OBJ", "The mesh"], ["glb", "GLB", "The mesh, for viewers and games"],
              ["original", "Original", "This shape on the vertices and faces of the garment's own file"],
              ["maps", "Maps", "Normals and heights as textures of the garment's own file"],
              ["moving glb", "Moving GLB", "How it moved, as an animation"], ["pc2", "PC2", "How it moved, as a point cache beside OBJ"]] as const).map(([as, label, title]) => (
              <button key={as} class="small" title={title} disabled={busy !== "" || !mayDraw} onClick={() => void give(as)}>{label}</button>
            ))}
            <button class="small" title="What is seen, as PNG" onClick={() => {
              parts.current!.view.savePicture(`${status.title}.png`);
              say(`The picture goes to the browser's downloads: ${status.title}.png.`);
            }}>Picture</button>
          </div>
        </section>}
      </aside>
      <footer data-dragging={dragging} data-step={status?.step} data-frames={frames} data-lines={status?.lines.length}>
        <div class={words.bad ? "say bad" : "say"} role={words.bad ? "alert" : "status"}>
          {gone ? "The program has ended. Every step is kept: start furrow studio again to go on." : words.text}
        </div>
        {lost && busy === "" && mayDraw && status?.undo === "drape" && <button class="main" onClick={() => void keepInstead()}>Undo and keep its lines</button>}
        {!mayDraw && status && !gone && <button class="main" onClick={() => void ask("take")}>Take the pen</button>}
        {(busy === "drape" || busy === "keep" || progress) && <>
          <span>{progress?.what}{progress && <Left progress={progress} />}</span>
          <progress max={1} value={progress?.share} aria-label={progress?.what ?? "working"} />
          <button onClick={() => void parts.current!.program.ask("cancel")}>Cancel</button>
        </>}
      </footer>
      {help && <Help close={() => setHelp(false)} />}
      {opening && <Open items={items} first={opening === "first"} files={files} bad={badFile} open={open} close={() => setOpening("")} />}
    </>
  );
}
