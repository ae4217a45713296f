// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the page: what its parts show, in one place.
import { useRef, useState } from "preact/hooks";
import type { ClothMap } from "./cloth";
import type { Files } from "./open";
import type { Done, GalleryItem, Progress, Status } from "./protocol";
import type { TouchKind } from "./touch";
import type { Seen } from "./view";

export type Tool = "look" | "ridge" | "valley" | "pin" | "touch";
export type Busy = "" | "drape" | "keep" | "touch" | "give" | "play";

/** How the height follows a pen's pressure: as it is, sooner, later, or not at all. */
export type Feel = "even" | "soft" | "firm" | "none";

/** Of the next line; width null: as the program chooses it. */
export interface Draft {
  height: number;
  width: number | null;
  feel: Feel;
}

/** Of the next touch: `strength`: of a pinch as much, of others all. */
export interface TouchDraft {
  kind: TouchKind;
  radius: number;
  strength: number;
  pinch: number;
}

/** What is said below the picture. `folder`: that of what was written; `link`: to what the page made. */
export interface Words {
  text: string;
  bad: boolean;
  folder?: "give" | "project";
  link?: string;
}

export interface State {
  status?: Status;
  me: number; // this client, as the program counts them
  gone: boolean; // the program has ended
  tool: Tool;
  draft: Draft;
  touch: TouchDraft;
  feels: boolean; // a pen has shown that it feels pressure
  both: boolean; // what is drawn is mirrored
  middle: number | null; // of the mirror, while it is dragged
  chosen: number; // line; -1: none
  dragging: boolean; // a line, by its dots
  seen: Seen;
  map: "" | ClothMap; // that the cloth's colours show
  tangles: boolean; // they show where cloth crosses cloth
  frames: number; // meshes that came so far
  busy: Busy;
  progress?: Progress;
  words: Words;
  verdict?: { step: number; done: Done }; // of the shape that the step made
  lost: boolean; // what was draped has lost lines
  moving: number; // time of the cloth in motion [s]
  speed: number; // of a play, over the clock's
  help: boolean;
  items: GalleryItem[];
  opening: "" | "first" | "again";
  files: Files;
  badFile: string;
}

const first: State = {
  me: 0,
  gone: false,
  tool: "look",
  draft: { height: 0.02, width: null, feel: "even" },
  touch: { kind: "iron", radius: 0.1, strength: 1, pinch: 0.3 },
  feels: false,
  both: false,
  middle: null,
  chosen: -1,
  dragging: false,
  seen: { body: true, wire: false, lines: true, clay: false },
  map: "",
  tangles: false,
  frames: 0,
  busy: "",
  words: { text: "", bad: false },
  lost: false,
  moving: 0,
  speed: 1,
  help: false,
  items: [],
  opening: "",
  files: { garment: null, body: null, madeFor: null },
  badFile: "",
};

/** The state as it is now, and a change of it that the parts show. */
export interface Page {
  now(): State;
  set(change: Partial<State>): void;
}

export function usePage(): Page {
  const [, show] = useState(first);
  const held = useRef<Page>();
  if (!held.current) {
    let state = first;
    held.current = { now: () => state, set: (change) => show((state = { ...state, ...change })) };
  }
  return held.current;
}

export const isPen = (tool: Tool) => tool === "ridge" || tool === "valley";
/** Whether this client has the pen, or nobody has. */
export const mayDraw = ({ status, me }: State) => !!status && (status.pen === me || status.pen === 0);
/** Whether the program does nothing that takes long, and would listen to this client. */
export const isIdle = (state: State) => state.busy === "" && mayDraw(state);
