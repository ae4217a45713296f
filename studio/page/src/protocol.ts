// SPDX-License-Identifier: GPL-3.0-or-later
// How the page talks to the program: it sends what the user means, with an id; the answer is `done` or `refused`.

export interface Line {
  name: string;
  on: boolean;
  varies: boolean;
  height?: number;
  width?: number;
  sharpness?: number;
  press?: number;
  gather?: number;
  closed?: boolean;
}
/** A closed border of the cloth: a hem, a neck, an arm hole; "top", "bottom", or a number. */
export interface Border {
  name: string;
  length: number;
  held: boolean;
}
export type Vector = [number, number, number];
export interface Status {
  title: string;
  lines: Line[];
  shown: number[];
  earlier: string[];
  fabric: string;
  fabrics: { name: string; words: string }[];
  borders: Border[];
  parts: { name: string; goes: boolean }[];
  wind: Vector;
  middle: number;
  has_body: boolean;
  made_for_another: boolean;
  can_drape: boolean;
  time: number;
  undo: string;
  redo: string;
  step: number;
  pen: number;
}
export interface GalleryItem {
  name: string;
  title: string;
  picture?: string; // a data URL
}
export interface Verdict {
  name: string;
  verdict: "held" | "pressed" | "strutted" | "lowered" | "may_hold" | "cannot_hold" | "not_known";
  words: string;
  at?: Vector; // the line's upper end
}
export interface Done {
  told?: string[];
  outcome?: string;
  time?: number;
  words?: string;
  legend?: string;
  remarks?: string[];
  written?: string[];
  moved?: number; // by a touch, at most [m]
  balances?: boolean;
  live?: boolean;
  passed_over?: boolean;
  points?: Vector[];
  verdicts?: Verdict[];
  all_hold?: boolean;
  lost?: boolean;
  pairs?: number;
  at?: Vector;
  file?: string;
  project?: string;
  first?: number;
  steps?: string[];
}
export interface Progress {
  what: string;
  share: number;
}
export interface Hearer {
  status(status: Status): void;
  you(client: number): void;
  gallery(items: GalleryItem[], open: boolean): void;
  opened(): void;
  progress(progress: Progress): void;
  frame(bytes: ArrayBuffer): void;
  gone(): void;
}

/** What the program would not do, and its sentence why. */
export class Refused extends Error {}

interface Waiting {
  resolve(done: Done): void;
  reject(why: Refused): void;
}

export class Program {
  private socket: WebSocket;
  private waiting = new Map<number, Waiting>();
  private next = 1;

  constructor(
    private token: string,
    hearer: Hearer,
  ) {
    this.socket = new WebSocket(`ws://${location.host}/ws?token=${token}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = (event: MessageEvent) => {
      if (typeof event.data !== "string") return hearer.frame(event.data as ArrayBuffer);
      const message = JSON.parse(event.data);
      if (message.status) hearer.status(message.status);
      if (message.you) hearer.you(message.you);
      if (message.gallery) hearer.gallery(message.gallery, message.open);
      if (message.opened) hearer.opened();
      if (message.progress) hearer.progress(message.progress);
      const waiting = this.waiting.get(message.id);
      if (!waiting) return;
      this.waiting.delete(message.id);
      if (message.done) waiting.resolve(message.done);
      else waiting.reject(new Refused(message.refused ?? "refused"));
    };
    this.socket.onclose = () => {
      for (const w of this.waiting.values()) w.reject(new Refused("the program has ended; nothing is lost"));
      this.waiting.clear();
      hearer.gone();
    };
  }

  /** Sends a file, and resolves to what stands for it in a message. */
  async upload(file: File): Promise<string> {
    const name = encodeURIComponent(file.name.replace(/[^A-Za-z0-9_.-]+/g, "-"));
    const answer = await fetch(`/upload?token=${this.token}&name=${name}`, { method: "PUT", body: file });
    const text = (await answer.text()).trim();
    if (!answer.ok) throw new Refused(`${file.name}: ${text}`);
    return text;
  }

  ask(what: string, body: object = {}): Promise<Done> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      if (this.socket.readyState !== WebSocket.OPEN)
        return reject(new Refused("the program has ended; start furrow studio again"));
      this.waiting.set(id, { resolve, reject });
      this.socket.send(JSON.stringify({ id, do: what, ...body }));
    });
  }
}
