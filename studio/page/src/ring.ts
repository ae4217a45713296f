// SPDX-License-Identifier: GPL-3.0-or-later
// How wide the pen's fold will be, as a ring on the cloth where the pen is.
import * as THREE from "three";
import type { Hit } from "./picker";
import type { View } from "./view";

const corners = 40;

export class Ring {
  private ring: SVGPolygonElement;
  private words: SVGTextElement;

  constructor(private view: View) {
    const svg = "http://www.w3.org/2000/svg",
      picture = document.createElementNS(svg, "svg");
    picture.setAttribute("class", "ring");
    picture.setAttribute("aria-hidden", "true");
    this.ring = picture.appendChild(document.createElementNS(svg, "polygon"));
    this.words = picture.appendChild(document.createElementNS(svg, "text"));
    view.canvas.after(picture);
  }

  /** `width`: of the fold [m]; `words`: beside the ring, or "". */
  show(hit: Hit, width: number, words: string, isValley: boolean) {
    const box = this.view.canvas.getBoundingClientRect(),
      aside = new THREE.Vector3(0, 1, 0).cross(hit.normal);
    if (aside.lengthSq() < 1e-6) aside.set(1, 0, 0);
    aside.normalize();
    const up = hit.normal.clone().cross(aside);
    const places = Array.from({ length: corners }, (_, i) => {
      const a = (2 * Math.PI * i) / corners,
        p = hit.shown
          .clone()
          .addScaledVector(aside, 0.5 * width * Math.cos(a))
          .addScaledVector(up, 0.5 * width * Math.sin(a));
      const [x, y] = this.view.picker.windowPlace(p);
      return [x - box.left, y - box.top];
    });
    this.ring.setAttribute("points", places.map((p) => p.map((v) => v.toFixed(1)).join()).join(" "));
    this.ring.setAttribute("class", isValley ? "valley" : "");
    this.words.textContent = words;
    this.words.setAttribute("x", `${Math.max(...places.map(([x]) => x)) + 6}`);
    this.words.setAttribute("y", `${places[0][1]}`);
  }

  hide() {
    this.ring.setAttribute("points", "");
    this.words.textContent = "";
  }
}
