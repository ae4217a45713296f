// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn on: a garment from the gallery, or the user's own file, with a body or without.
import { useEffect, useRef, useState } from "preact/hooks";
import { figuresOf } from "./figures";
import type { GalleryItem } from "./protocol";

export interface Files {
  garment: File | null;
  body: File | null;
  madeFor: File | null;
  figures?: Partial<Record<Role, string>>; // of a file that has several
}
type Role = "garment" | "body" | "madeFor";
export interface OpenWords {
  item?: string;
  files?: Files;
  unit?: string;
  up?: string;
}
interface Props {
  items: GalleryItem[];
  first: boolean;
  files: Files;
  bad: string;
  open(words: OpenWords): Promise<void>;
  close(): void;
}

/** Files that were dropped together: what is called a body or a person is the body, else the second. */
export function sorted(dropped: File[]): Files {
  const meshes = dropped.filter((f) => /\.(obj|ply|off|stl|glb|vrm|fbx)$/i.test(f.name));
  const figure =
    meshes.length > 1
      ? (meshes.find((f) => /body|figure|mannequin|avatar|human|person/i.test(f.name)) ?? meshes[1])
      : null;
  return { garment: meshes.find((f) => f !== figure) ?? null, body: figure, madeFor: null };
}

function Choice({
  label,
  value,
  all,
  change,
}: {
  label: string;
  value: string;
  all: [string, string][];
  change(value: string): void;
}) {
  return (
    <label>
      {label}
      <select value={value} onChange={(e) => change(e.currentTarget.value)}>
        {all.map(([word, shown]) => (
          <option key={word} value={word}>
            {shown}
          </option>
        ))}
      </select>
    </label>
  );
}

function FileField({
  label,
  role,
  files,
  change,
}: {
  label: string;
  role: Role;
  files: Files;
  change(files: Partial<Files>): void;
}) {
  const file = files[role];
  const [names, setNames] = useState<string[]>([]);
  useEffect(() => {
    let current = true;
    setNames([]);
    if (file) void figuresOf(file).then((found) => current && setNames(found));
    return () => void (current = false);
  }, [file]);
  const named = (name: string) => change({ figures: { ...files.figures, [role]: name } });
  return (
    <>
      <label class="file">
        {label}
        <input
          type="file"
          accept=".obj,.ply,.off,.stl,.glb,.vrm,.fbx"
          onChange={(e) =>
            change({ [role]: e.currentTarget.files?.[0] ?? null, figures: { ...files.figures, [role]: "" } })
          }
        />
        {file && <span class="note">{file.name}</span>}
      </label>
      {names.length > 1 && (
        <Choice
          label={`${label} in it`}
          value={files.figures?.[role] ?? ""}
          change={named}
          all={[["", "all of it"], ...names.map((name): [string, string] => [name, name])]}
        />
      )}
    </>
  );
}

export function Open({ items, first, files, bad, open, close }: Props) {
  const dialog = useRef<HTMLDialogElement>(null);
  const [chosen, setChosen] = useState<Files>(files);
  const [unit, setUnit] = useState(""),
    [up, setUp] = useState(""),
    [busy, setBusy] = useState(false);
  useEffect(() => dialog.current?.showModal(), []);
  // An effect comes after the first picture, and would take back what was chosen by then.
  const dropped = useRef(files);
  useEffect(() => {
    if (dropped.current !== files) setChosen((dropped.current = files));
  }, [files]);
  const take = (files: Partial<Files>) =>
    setChosen((c) => {
      const now = { ...c, ...files };
      return { ...now, madeFor: now.body && now.madeFor };
    });
  const go = async (words: OpenWords) => {
    setBusy(true);
    await open(words);
    setBusy(false);
  };
  return (
    <dialog
      ref={dialog}
      class="open"
      onClose={close}
      onCancel={(e) => first && e.preventDefault()}
      aria-labelledby="open-title"
    >
      <h2 id="open-title">{first ? "What do you want to draw on?" : "Open another garment"}</h2>
      {items.length > 0 && (
        <div class="gallery">
          {items.map((item) => (
            <button key={item.name} disabled={busy} onClick={() => void go({ item: item.name })}>
              {item.picture && <img src={item.picture} alt="" />}
              <span>{item.title}</span>
            </button>
          ))}
        </div>
      )}
      <h3>Your own</h3>
      <p class="note">
        Drop files anywhere on this page, or choose them: OBJ, PLY, OFF, STL, GLB, VRM or FBX, up to 64 MB
        each.
      </p>
      <div class="fields">
        <FileField label="Garment" role="garment" files={chosen} change={take} />
        <FileField label="Body" role="body" files={chosen} change={take} />
        {chosen.body && <FileField label="Made for" role="madeFor" files={chosen} change={take} />}
        <Choice
          label="Unit"
          value={unit}
          change={setUnit}
          all={[
            ["", "as its size says"],
            ["m", "metres"],
            ["cm", "centimetres"],
            ["mm", "millimetres"],
            ["inch", "inches"],
          ]}
        />
        <Choice
          label="Upwards"
          value={up}
          change={setUp}
          all={[
            ["", "as its shape says"],
            ["y", "y"],
            ["z", "z"],
          ]}
        />
      </div>
      {chosen.body && (
        <p class="note">
          Made for: the body that the garment lies about, if it was made for another one. Drape brings it to
          yours.
        </p>
      )}
      {bad && (
        <p class="say bad" role="alert">
          {bad}
        </p>
      )}
      <div class="group">
        <button
          class="main"
          disabled={busy || !chosen.garment}
          onClick={() => void go({ files: chosen, unit, up })}
        >
          {busy ? "Opening …" : "Open"}
        </button>
        {!first && <button onClick={() => dialog.current?.close()}>Cancel</button>}
      </div>
    </dialog>
  );
}
