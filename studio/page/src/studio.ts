// SPDX-License-Identifier: GPL-3.0-or-later
// What the page does: each method asks the program for something, and shows what it answers.
import { Vector3 } from "three";
import type { ClothActions, ClothMap } from "./cloth";
import { titleOf } from "./fabrics";
import { Kind, readFrame } from "./frame";
import { Hand } from "./hand";
import { Handles } from "./handles";
import { LineChanges } from "./line_changes";
import { ownWidth } from "./lines";
import type { OpenWords } from "./open";
import { type Draft, type Feel, isIdle, isPen, mayDraw, type Page, type Tool, type Words } from "./page";
import { type Drawn, Pen } from "./pen";
import { type Done, type Hearer, Program, type Vector } from "./protocol";
import { Touch } from "./touch";
import { recordTurn } from "./turn";
import { type Seen, View } from "./view";

/** A draft of another size: the whole fold, in whole millimetres. */
function resized(draft: Draft, factor: number): Draft {
  const scaled = (length: number, least: number, most: number) =>
    Math.min(most, Math.max(least, Math.round(length * factor * 1000) / 1000));
  return {
    ...draft,
    height: scaled(draft.height, 0.002, 0.1),
    width: draft.width === null ? null : scaled(draft.width, 0.01, 0.3),
  };
}

const bends: Record<Feel, number> = { even: 1, soft: 0.5, firm: 2, none: 0 };

/** The height at each point of a line over that which is set: 1 where the pen is held as usual. */
const shares = (pressures: number[], feel: Feel) =>
  pressures.map((p) => Math.min(2, Math.max(0.2, (2 * p) ** bends[feel])));

const sentences = (...all: (string | string[] | undefined)[]) => all.flat().filter(Boolean).join("\n");

export class Studio {
  readonly program: Program;
  readonly view: View;
  readonly pen: Pen;
  readonly handles: Handles;
  readonly hand: Hand;
  readonly touch: Touch;
  readonly lines: LineChanges;
  /** What the panel of the cloth asks for. */
  readonly cloth: ClothActions = {
    fabric: (name) => this.setFabric(name),
    hold: (border, on) => void this.ask("hold", { border, on }),
    attach: (part, on) => void this.ask("attach", { part, on }),
    wind: (velocity) => void this.blow(velocity),
    drape: () => void this.drape(),
    keep: () => void this.keep(),
    play: (seconds) => void this.play(seconds),
    map: (of) => void this.showMap(of),
    accept: (drapes) => this.accept(drapes),
    takeBack: () => this.undo(),
    pace: (speed) => this.page.set({ speed }),
  };
  private playsAgain = false; // once it has paused
  private sizedFrom: Draft | null = null; // the draft before the drag that changes its size

  constructor(
    private page: Page,
    canvas: HTMLCanvasElement,
    token: string,
  ) {
    this.view = new View(canvas);
    this.program = new Program(token, this.hearer());
    this.lines = new LineChanges(page, this);
    this.pen = new Pen(this.view, () => this.penSettings(), {
      feels: () => page.now().feels || page.set({ feels: true }),
      sized: (factor, isOver) => this.dragSize(factor, isOver),
      drawn: (line) => void this.draw(line),
      tooShort: () =>
        this.say("That was too short for a line: hold the button down and draw over the cloth."),
    });
    this.handles = new Handles(this.view, () => this.canDrag(), {
      moved: (points, isLive) => {
        page.set({ dragging: isLive });
        this.lines.set(page.now().chosen, { points }, isLive);
      },
      dropped: () => {
        page.set({ dragging: false });
        this.lines.dropWaiting();
        void this.program.ask("show");
      },
    });
    this.followPointer(canvas);
    this.touch = new Touch(
      this.view,
      this.pen.ring,
      () => {
        const { tool, touch } = page.now();
        return { on: tool === "touch" && isIdle(page.now()), kind: touch.kind, radius: touch.radius };
      },
      (at, by) => void this.touchAt(at, by),
    );
    this.hand = new Hand(this.view, () => this.handDoes(), {
      // What the program does not want to hear any more, as the cloth has just been paused, is no fault.
      pulls: (grip) => void this.program.ask("pull", grip ?? {}).catch(() => undefined),
      pins: (at, border) => void this.ask(border ? "hold" : "pin", { at }),
      encircles: (vertices, on) => {
        if (vertices.length) void this.ask("pin", { vertices, on });
        else this.say("There is no vertex of the cloth within that loop: draw it larger, or click.");
      },
    });
  }

  /** What is clicked on is touched. */
  private async touchAt(at: Vector3, by: Vector3 | null) {
    const { kind, radius, strength, pinch } = this.page.now().touch;
    const touch = {
      [kind]: at.toArray(),
      radius,
      strength: kind === "pinch" ? pinch : strength,
      ...(by && { by: by.toArray() }),
    };
    this.page.set({ busy: "touch" });
    await this.ask("touch", { touch }, ({ moved, balances, pairs }) =>
      sentences(
        `The cloth moved by up to ${(1000 * moved!).toFixed(1)} mm there. Touch more, drape, or undo.`,
        balances ? undefined : "It has found no balance there yet; Drape lets it come to rest.",
        pairs ? `Cloth crosses cloth since, ${pairs} faces: T shows where, Undo takes it back.` : undefined,
      ),
    );
    this.page.set({ busy: "", progress: undefined });
  }

  /** Lines and pens show where the pointer is, once a picture. */
  private followPointer(canvas: HTMLCanvasElement) {
    let at: PointerEvent | null = null;
    canvas.addEventListener("pointermove", (e) => {
      if (at === null) requestAnimationFrame(() => follow());
      at = e;
    });
    canvas.addEventListener("pointerleave", () => this.view.marks.point(null));
    const follow = () => {
      const { buttons, clientX, clientY } = at!;
      at = null;
      if (buttons === 0 && this.page.now().busy !== "play")
        this.view.marks.point(this.view.marks.lineAt(clientX, clientY));
    };
  }

  private hearer(): Hearer {
    const { page } = this;
    return {
      status: (status) => page.set({ status }),
      you: (me) => page.set({ me }),
      gone: () => page.set({ gone: true }),
      gallery: (items, open) => page.set(open ? { items } : { items, opening: "first" }),
      opened: () => {
        this.view.forget();
        page.set({
          chosen: -1,
          verdict: undefined,
          tool: "look",
          words: { text: "", bad: false },
          opening: "",
        });
      },
      progress: (progress) => page.set({ progress: progress.share < 1 ? progress : undefined }),
      frame: (bytes) => this.show(bytes),
    };
  }

  private show(bytes: ArrayBuffer) {
    const { page, view } = this,
      frame = readFrame(bytes);
    if ("time" in frame) {
      if (frame.kind === Kind.movingBody) return view.moveBody(frame.positions);
      view.move(frame.positions);
      this.hand.follow();
      return page.set({ moving: frame.time, map: "" });
    }
    if ("colours" in frame) return view.colour(frame.colours);
    view.show(frame);
    if (frame.kind !== Kind.body) {
      this.handles.show();
      if (!this.pen.drawing) view.showBand([], 0, 0);
    }
    if (frame.kind === Kind.cloth) page.set({ map: "", tangles: false });
    page.set({ frames: page.now().frames + 1 });
  }

  say(text: string, bad = false, more: Partial<Words> = {}) {
    const { link } = this.page.now().words;
    if (link) URL.revokeObjectURL(link);
    this.page.set({ words: { text, bad, ...more } });
  }

  /** Asks the program; what it says against it is shown in its words. */
  async ask(what: string, body: object = {}, then?: (done: Done) => string, folder?: Words["folder"]) {
    if (this.page.now().busy === "play") this.pause(); // what is asked then wants it still
    try {
      const done = await this.program.ask(what, body);
      this.say(
        sentences(
          then?.(done),
          (done.told ?? []).map((t) => `Note: ${t}`),
        ),
        false,
        { folder },
      );
      return true;
    } catch (e) {
      const why = (e as Error).message;
      this.say(why, !why.startsWith("stopped;")); // which was asked for
      return false;
    }
  }

  /** Asks for what takes long. */
  private async work(busy: "drape" | "keep" | "give", body: object, then: (done: Done) => string) {
    this.page.set({ busy });
    await this.ask(busy, body, then, busy === "give" ? "give" : undefined);
    this.page.set({ busy: "", progress: undefined });
  }

  private penSettings() {
    const { tool, draft, busy } = this.page.now(),
      { ridge, valley } = this.view.colours;
    return {
      on: isPen(tool) && !busy,
      colour: tool === "valley" ? valley : ridge,
      width: draft.width ?? ownWidth(draft.height),
      isValley: tool === "valley",
    };
  }

  /** Another size of the pen, by a key. */
  resize(factor: number) {
    const { draft, tool, touch } = this.page.now(),
      next = resized(draft, factor);
    if (tool === "touch") {
      const radius = Math.min(0.4, Math.max(0.02, Math.round(touch.radius * factor * 200) / 200));
      this.page.set({ touch: { ...touch, radius } });
      return this.touch.follow(true);
    }
    // A step is a millimetre at least.
    if (next.height === draft.height)
      next.height = resized({ ...draft, height: draft.height + Math.sign(factor - 1) / 1000 }, 1).height;
    this.page.set({ draft: next });
    if (isPen(tool)) this.pen.follow(true);
  }

  private dragSize(factor: number, isOver: boolean) {
    this.sizedFrom ??= this.page.now().draft;
    this.page.set({ draft: resized(this.sizedFrom, factor) });
    if (isOver) this.sizedFrom = null;
    this.pen.follow();
  }

  private async draw({ points, closed, pressures = [] }: Drawn) {
    const { tool, draft, both, status } = this.page.now(),
      place = status!.lines.length,
      size = tool === "valley" ? -draft.height : draft.height;
    const felt = shares(pressures, draft.feel),
      mean = felt.length ? felt.reduce((sum, share) => sum + share, 0) / felt.length : 1;
    const varies = felt.length > 0 && Math.max(...felt) > 1.15 * Math.min(...felt);
    const body = {
      height: size * mean,
      points,
      closed,
      ...(varies && { heights: felt.map((share) => size * share) }),
      ...(draft.width !== null && { width: draft.width }),
      ...(both && { mirror: true }),
    };
    if (await this.ask("draw", body))
      this.page.set({ chosen: place }); // its sliders are open
    else this.pen.drop();
  }

  private canDrag() {
    const state = this.page.now();
    return state.tool === "look" && isIdle(state) && !!state.status?.lines[state.chosen]?.on;
  }

  private handDoes() {
    const state = this.page.now();
    if (!mayDraw(state)) return "";
    if (state.busy === "play") return "pull";
    return state.tool === "pin" && !state.busy ? "pin" : "";
  }

  async drape() {
    if (this.page.now().busy) return;
    this.page.set({ lost: false });
    this.say("The cloth comes to rest …");
    await this.work("drape", {}, (done) => {
      this.page.set({ lost: done.lost ?? false });
      const outcome =
        done.outcome === "at rest"
          ? "The cloth is at rest. Draw more, or undo."
          : `Outcome: ${done.outcome}.`;
      return sentences(outcome, done.remarks);
    });
  }

  async keep() {
    if (this.page.now().busy) return;
    this.say(
      "The lines are tried: each has to hold, at rest and in a gust. That takes minutes on a large garment, " +
        "and can be stopped.",
    );
    await this.work("keep", {}, (done) => {
      this.page.set({ verdict: { step: this.page.now().status!.step, done } });
      const outcome = done.all_hold
        ? "Every line holds."
        : "Not every line is sure to hold; the list says why.";
      return sentences(outcome, done.remarks);
    });
  }

  /** Back to where the lines were drawn, and they are made to last there. */
  async keepInstead() {
    this.page.set({ lost: false });
    if (await this.ask("undo")) await this.keep();
  }

  /** Goes on with what was kept as it is; `drapes`: and lets the cloth come to rest. */
  accept(drapes: boolean) {
    this.page.set({ verdict: undefined });
    if (drapes) void this.drape();
  }

  async showTangles() {
    if (this.page.now().tangles) {
      this.page.set({ tangles: false });
      return this.view.colour(null);
    }
    await this.ask("tangles", {}, (done) => {
      this.page.set({ tangles: done.pairs! > 0, map: "" });
      if (done.at) this.view.lookAt(new Vector3(...done.at));
      return done.words!;
    });
  }

  /** Shows strain, the distance to the body, or mass, or the cloth's own colour again. */
  async showMap(of: ClothMap) {
    if (this.page.now().map === of) {
      this.page.set({ map: "" });
      return this.view.colour(null);
    }
    const what = of === "mass" ? "weigh" : "fit";
    if (await this.ask(what, { by: of }, (done) => `${done.words}\n${done.legend}`))
      this.page.set({ map: of });
  }

  pause() {
    void this.program.ask("pause");
  }

  /** Moves the cloth until it is paused, or takes one step. */
  async play(seconds?: number) {
    const { page } = this,
      { busy, status, tool, speed } = page.now();
    if (busy === "play") return this.pause();
    if (!isIdle(page.now()) || !status?.can_drape) return;
    page.set({ busy: "play", tool: isPen(tool) ? "look" : tool, moving: status.time }); // the pointer pulls now
    this.say("");
    await this.ask("play", seconds ? { seconds } : { speed }, (done) =>
      sentences(`It has moved for ${done.time!.toFixed(2)} s. Draw more, go on, or undo.`, done.remarks),
    );
    page.set({ busy: "" });
    this.goOn();
  }

  /** In a wind that changes while the cloth moves, it moves on. */
  async blow(velocity: Vector) {
    const moves = this.page.now().busy === "play";
    if (!(await this.ask("wind", { velocity })) || !moves) return;
    this.playsAgain = true;
    if (this.page.now().busy === "") this.goOn();
  }

  private goOn() {
    if (!this.playsAgain) return;
    this.playsAgain = false;
    void this.play();
  }

  undo() {
    const what = this.page.now().status?.undo;
    this.page.set({ lost: false });
    void this.ask("undo", {}, () => `Undone: ${what}.`);
  }

  redo() {
    const what = this.page.now().status?.redo;
    void this.ask("redo", {}, () => `Done again: ${what}.`);
  }

  /** So many steps back, or on where that is negative. */
  async goBack(steps: number) {
    this.page.set({ lost: false });
    for (let i = 0; i < Math.abs(steps); ++i) if (!(await this.ask(steps > 0 ? "undo" : "redo"))) return;
  }

  save() {
    void this.ask(
      "save",
      {},
      (done) => `Saved in ${this.page.now().status?.title}: ${(done.written ?? []).join(", ")}.`,
      "project",
    );
  }

  give(as: string) {
    void this.work("give", { as }, (done) => `Written: ${done.file}`);
  }

  /** Shows the folder of what was written, in whatever shows folders here. */
  async openFolder(of: "give" | "project") {
    const { words } = this.page.now();
    try {
      await this.program.ask("folder", { of });
    } catch (e) {
      this.page.set({ words: { ...words, text: (e as Error).message, bad: true } });
    }
  }

  async takePicture() {
    const name = `${this.page.now().status!.title}.png`;
    this.say("The picture is taken …"); // what was said against something else goes at once
    this.download(await this.view.picture(), name, "The picture");
  }

  /** A round about the cloth as a GIF that goes on for ever. */
  async takeTurn() {
    const name = `${this.page.now().status!.title}-turn.gif`;
    this.say("The camera goes round the cloth …");
    this.download(new Blob([await recordTurn(this.view)], { type: "image/gif" }), name, "The turn");
  }

  private download(made: Blob | null, name: string, what: string) {
    if (!made) return this.say("The browser made no picture of it.", true);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(made);
    link.download = name;
    link.click();
    this.say(`${what} goes to the browser's downloads: ${name}.`, false, { link: link.href });
  }

  setFabric(name: string) {
    void this.ask(
      "fabric",
      { name },
      () => `It is made of ${titleOf(name).toLowerCase()} now; Drape or Play shows how that hangs.`,
    );
  }

  async open({ item, files, unit, up }: OpenWords) {
    const { page, program } = this,
      sent = async (file?: File | null) => file && (await program.upload(file));
    page.set({ badFile: "" });
    try {
      const garment = await sent(files?.garment),
        body = await sent(files?.body),
        made_for = await sent(files?.madeFor);
      const figures = {
        ...(files?.figures?.garment && { garment: files.figures.garment }),
        ...(files?.figures?.body && { body: files.figures.body }),
        ...(files?.figures?.madeFor && { made_for: files.figures.madeFor }),
      };
      const own = {
        garment,
        ...(body && { body }),
        ...(made_for && { made_for }),
        ...(Object.keys(figures).length > 0 && { figures }),
        ...(unit && { unit }),
        ...(up && { up }),
      };
      const done = await program.ask("open", item ? { item } : own);
      this.say(sentences(`Every step is kept in ${done.project}.`, done.told));
      page.set({ files: { garment: null, body: null, madeFor: null } });
    } catch (e) {
      page.set({ badFile: (e as Error).message });
    }
  }

  toggle(key: keyof Seen) {
    const { seen } = this.page.now();
    this.page.set({ seen: { ...seen, [key]: !seen[key] } });
  }

  /** Takes up a tool, or lays it down. */
  pick(tool: Tool) {
    const { tool: old, busy } = this.page.now();
    if (tool !== "look" && busy === "play") this.pause(); // who picks up a pen wants the cloth to hold still
    this.page.set({ tool: old === tool ? "look" : tool });
  }

  /** Drops what the pointer does, else lays the tool down. */
  escape() {
    if (this.pen.drawing) this.pen.drop();
    else if (this.hand.encircling) this.hand.drop();
    else if (this.handles.dragging) this.handles.drop();
    else if (this.touch.pulling) this.touch.drop();
    else this.page.set({ tool: "look" });
  }
}
