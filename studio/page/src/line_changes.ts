// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of lines that were drawn. While a slider moves, one change is on its way and the newest waits.
import type { LineActions, LineChange } from "./lines";
import type { Page } from "./page";
import type { Line } from "./protocol";
import type { Studio } from "./studio";

/** A line with a change that is not answered yet; several at once keep their signs. */
const changed = (
  line: Line,
  { points, width, height, gather, ...more }: LineChange,
  isOneOfSeveral: boolean,
): Line => ({
  ...line,
  ...more,
  ...(width !== undefined && { width: width ?? undefined }),
  ...(gather !== undefined && { gather: gather ?? undefined }),
  ...(height !== undefined &&
    !(isOneOfSeveral && line.gather) && {
      height: isOneOfSeveral && (line.height ?? 1) < 0 ? -height : height,
      varies: false,
    }),
});

export class LineChanges implements LineActions {
  private running = false;
  private waiting: (() => void) | null = null;

  constructor(
    private page: Page,
    private studio: Studio,
  ) {}

  choose(line: number) {
    this.page.set({ chosen: line });
  }

  point(line: number | null) {
    const shown = line === null ? -1 : (this.page.now().status?.shown.indexOf(line) ?? -1);
    this.studio.view.marks.point(shown < 0 ? null : shown);
  }

  set(lines: number | number[], change: LineChange, isLive: boolean) {
    const isOneOfSeveral = Array.isArray(lines),
      body = { ...(isOneOfSeveral ? { lines } : { line: lines }), ...change };
    if (isLive) {
      const send = () => void this.preview(body);
      if (this.running) this.waiting = send;
      else send();
      return;
    }
    this.waiting = null;
    // The panel has it at once: what is pressed next goes on from there.
    const { status } = this.page.now(),
      isMeant = (i: number) => [lines].flat().includes(i);
    if (status)
      this.page.set({
        status: {
          ...status,
          lines: status.lines.map((l, i) => (isMeant(i) ? changed(l, change, isOneOfSeveral) : l)),
        },
      });
    // What is refused leaves no preview behind.
    void this.studio.ask("set", body).then((is) => void (is || this.studio.program.ask("show")));
  }

  private async preview(body: object) {
    this.running = true;
    this.waiting = null;
    await this.studio.ask("set", { ...body, live: true });
    this.running = false;
    (this.waiting as (() => void) | null)?.();
  }

  /** What was dragged lies where it was. */
  dropWaiting() {
    this.waiting = null;
  }

  remove(line: number) {
    void this.studio.ask("delete", { line });
  }

  async mirror(line: number) {
    if (await this.studio.ask("mirror", { line })) this.chooseLast();
  }

  async duplicate(line: number) {
    if (await this.studio.ask("duplicate", { line })) this.chooseLast();
  }

  private chooseLast() {
    this.choose(this.page.now().status!.lines.length - 1);
  }

  async move(line: number, to: number) {
    const count = this.page.now().status!.lines.length;
    if (to >= 0 && to < count && (await this.studio.ask("move", { line, to }))) this.choose(to);
  }
}
