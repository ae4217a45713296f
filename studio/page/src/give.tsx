// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs take.
import { isIdle, type Page } from "./page";
import type { Studio } from "./studio";

const forms = [
  ["ply", "PLY", "The mesh, with all that is known of it"],
  ["obj", "OBJ", "The mesh"],
  ["glb", "GLB", "The mesh, for viewers and games"],
  ["original", "Original", "This shape on the vertices and faces of the garment's own file"],
  ["maps", "Maps", "Normals and heights as textures of the garment's own file"],
  ["moving glb", "Moving GLB", "How it moved, as an animation"],
  ["pc2", "PC2", "How it moved, as a point cache beside OBJ"],
] as const;

export function GiveAway({ page, studio }: { page: Page; studio: Studio }) {
  return (
    <section aria-label="Give away">
      <h2>Give away</h2>
      <div class="group wrap">
        {forms.map(([as, label, title]) => (
          <button
            key={as}
            class="small"
            title={title}
            disabled={!isIdle(page.now())}
            onClick={() => studio.give(as)}
          >
            {label}
          </button>
        ))}
        <button class="small" title="What is seen, as PNG" onClick={() => void studio.takePicture()}>
          Picture
        </button>
        <button
          class="small"
          title="Once round it, as a GIF"
          disabled={!isIdle(page.now())}
          onClick={() => void studio.takeTurn()}
        >
          Turn
        </button>
      </div>
    </section>
  );
}
