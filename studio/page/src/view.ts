// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen: cloth, body, lines and pins, and the camera that looks at them. It draws when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { clayTexture } from "./clay";
import { type Frame, Kind } from "./frame";
import { Marks } from "./marks";
import { type Hit, Picker } from "./picker";

export interface Seen {
  body: boolean;
  wire: boolean;
  lines: boolean;
  clay: boolean; // the cloth without its colour, by a light that shows its shape alone
}
export type Side = "front" | "back" | "right";

interface Colours {
  ground: number;
  cloth: number;
  body: number;
  ridge: number;
  valley: number;
  wire: number;
}
const light: Colours = {
  ground: 0xeceef1,
  cloth: 0xd9cdb8,
  body: 0xb9bcc2,
  ridge: 0xd4610f,
  valley: 0x2a6fd6,
  wire: 0x39424e,
};
const dark: Colours = {
  ground: 0x1b1e22,
  cloth: 0xc9bca5,
  body: 0x6d737c,
  ridge: 0xff9a52,
  valley: 0x7fb0ff,
  wire: 0x14171b,
};

/** A picture that takes longer is drawn with fewer pixels while things change [ms]. */
const slow = 45;

/** Where the light stands, as the camera looks [the cloth's size]: aside, so that low folds have a light and a dark
 *  flank. */
const raking = new THREE.Vector3(-1.7, 1.1, 1.25);

/** Where a point of the pen's band lies above the cloth [share of the cloth's size]. */
const lift = 0.0018;

export class View {
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  readonly renderer: THREE.WebGLRenderer;
  readonly cloth: THREE.Mesh;
  readonly body: THREE.Mesh;
  readonly picker = new Picker(this);
  readonly marks = new Marks(this);
  frame?: Frame; // the cloth's, as it lies now
  colours = light;
  size = 1; // the cloth's diagonal [m]
  seen: Seen = { body: true, wire: false, lines: true, clay: false };
  private scene = new THREE.Scene();
  private key = new THREE.DirectionalLight();
  private fill = new THREE.DirectionalLight(); // so that no side is black
  private wire: THREE.LineSegments;
  private band: THREE.Mesh;
  private pins: THREE.Points;
  private handles: THREE.Points;
  private plane: THREE.Mesh;
  private rope: THREE.Line;
  private isWide = false; // the body is looked at, too
  private lookedFrom = new THREE.Vector3();
  private asked = false;
  private takes = 0; // the last picture with all pixels [ms]
  private timed?: Frame; // of which it was
  private isCoarse = false;
  private fineSoon = 0;
  private framed = false;
  private isRecording = false;
  private fabric: THREE.MeshStandardMaterial;
  private clay: THREE.MeshMatcapMaterial;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(2048, 2048);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener("change", () => this.draw());
    const mesh = (material: THREE.Material) => new THREE.Mesh(new THREE.BufferGeometry(), material);
    const side = THREE.DoubleSide;
    const behind = { side, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    this.fabric = new THREE.MeshStandardMaterial({ roughness: 0.92, ...behind });
    this.clay = new THREE.MeshMatcapMaterial({ matcap: clayTexture(), ...behind });
    this.cloth = mesh(this.fabric);
    this.body = mesh(
      new THREE.MeshStandardMaterial({
        roughness: 0.75,
        polygonOffset: true,
        polygonOffsetFactor: 3,
        polygonOffsetUnits: 3,
      }),
    );
    this.wire = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ transparent: true, opacity: 0.35 }),
    );
    this.band = mesh(
      new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.55, side, depthWrite: false }),
    );
    this.pins = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({ size: 5, sizeAttenuation: false }),
    );
    this.handles = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({ size: 13, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    this.plane = mesh(
      new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.14, side, depthWrite: false }),
    );
    this.rope = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false }));
    // Its edges, which are seen from the front, too.
    this.plane.add(new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial()));
    this.plane.visible = this.rope.visible = this.handles.visible = false;
    this.handles.renderOrder = this.rope.renderOrder = 3;
    for (const solid of [this.cloth, this.body]) solid.castShadow = solid.receiveShadow = true;
    this.scene.add(this.handles, this.plane, this.rope);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8478, 0.85), this.key, this.fill, this.key.target);
    this.scene.add(
      this.cloth,
      this.body,
      this.wire,
      this.marks.group,
      this.marks.signs,
      this.pins,
      this.band,
    );
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    scheme.addEventListener("change", () => this.paint(scheme.matches));
    this.paint(scheme.matches);
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement!);
    this.fit();
  }

  private paint(isDark: boolean) {
    this.colours = isDark ? dark : light;
    this.scene.background = new THREE.Color(this.colours.ground);
    if (!this.fabric.vertexColors) this.fabric.color.set(this.colours.cloth);
    (this.body.material as THREE.MeshStandardMaterial).color.set(this.colours.body);
    (this.wire.material as THREE.LineBasicMaterial).color.set(this.colours.wire);
    for (const dots of [this.pins, this.handles])
      (dots.material as THREE.PointsMaterial).color.set(this.colours.valley);
    (this.plane.material as THREE.MeshBasicMaterial).color.set(this.colours.valley);
    ((this.plane.children[0] as THREE.LineSegments).material as THREE.LineBasicMaterial).color.set(
      this.colours.valley,
    );
    (this.rope.material as THREE.LineBasicMaterial).color.set(this.colours.ridge);
    this.marks.renew();
    this.draw();
  }

  private fit() {
    const { clientWidth: w, clientHeight: h } = this.canvas.parentElement!;
    if (!w || !h || this.isRecording) return;
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws soon: once, however often it was asked. Where pictures take long, one with a quarter of the pixels comes
   *  first, and the fine one when nothing has changed for a while. */
  draw() {
    if (this.asked) return;
    this.asked = true;
    this.canvas.dataset.due = ""; // which is for tests: a picture, or a finer one, is to come
    requestAnimationFrame(() => {
      this.asked = false;
      if (this.isRecording) return;
      this.render(this.takes > slow);
      clearTimeout(this.fineSoon);
      if (this.isCoarse || this.timed !== this.frame)
        this.fineSoon = window.setTimeout(() => this.renderFine(), 300);
      else delete this.canvas.dataset.due;
    });
  }

  /** Nobody waits: draws with all pixels, and takes the time that this takes. */
  private renderFine() {
    if (this.isRecording) return;
    const start = performance.now(),
      gl = this.renderer.getContext();
    this.render(false);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
    this.takes = performance.now() - start;
    this.timed = this.frame;
    if (!this.asked) delete this.canvas.dataset.due;
  }

  private render(isCoarse: boolean) {
    this.isCoarse = isCoarse;
    this.renderWith(Math.min(devicePixelRatio, 2) * (isCoarse ? 0.5 : 1), !isCoarse);
  }

  /** `ratio`: pixels of the picture a pixel of the page. */
  private renderWith(ratio: number, hasShadows: boolean, camera = this.camera) {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio); // which sets the size, too
    const fromAside = raking.clone().multiplyScalar(this.size).applyQuaternion(camera.quaternion);
    this.key.target.position.copy(this.controls.target);
    this.key.position.copy(this.controls.target).add(fromAside); // however far the camera is
    this.fill.target = this.key.target;
    this.fill.position.copy(camera.position);
    this.shade(hasShadows);
    // three counts a picture before it draws the shadows, and would take what has changed since then for sent.
    ++this.renderer.info.render.frame;
    this.renderer.render(this.scene, camera);
  }

  /** Shadows of the light from above; pictures without have the same shaders, and see none. */
  private shade(isOn: boolean) {
    this.key.shadow.intensity = isOn ? 1 : 0;
    this.renderer.shadowMap.needsUpdate = isOn;
    const { camera } = this.key.shadow,
      around = 1.1 * this.size;
    if (camera.right === around) return;
    camera.left = camera.bottom = -around;
    camera.right = camera.top = around;
    camera.near = 0.4 * this.size;
    camera.far = 4.5 * this.size;
    camera.updateProjectionMatrix();
    this.key.shadow.normalBias = 0.004 * this.size;
    this.key.shadow.bias = -0.0004;
  }

  private geometryOf(frame: Frame): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(frame.positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(frame.faces, 1));
    geometry.computeVertexNormals();
    return geometry;
  }

  /** Another garment comes: the body goes, and the camera looks at what comes from the front. */
  forget() {
    this.body.geometry.dispose();
    this.body.geometry = new THREE.BufferGeometry();
    this.picker.forgetBody();
    this.framed = false;
  }

  show(frame: Frame) {
    if (frame.kind === Kind.body) {
      this.body.geometry.dispose();
      this.body.geometry = this.geometryOf(frame);
      this.picker.forgetBody();
      return this.draw();
    }
    this.frame = frame;
    this.cloth.geometry.dispose();
    this.cloth.geometry = this.geometryOf(frame);
    this.colour(null);
    this.picker.forgetCloth();
    this.cloth.geometry.computeBoundingBox();
    this.size = this.cloth.geometry.boundingBox!.getSize(new THREE.Vector3()).length();
    this.showWire();
    this.marks.renew();
    this.showPins();
    if (!this.framed) this.look("front");
    this.framed = true;
    this.draw();
  }

  /** Paints the cloth; null: its own colour. */
  colour(colours: Uint8Array | null) {
    const material = this.fabric;
    const fits = colours !== null && colours.length === this.frame?.positions.length;
    if (material.vertexColors !== fits) material.needsUpdate = true;
    material.vertexColors = fits;
    material.color.set(fits ? 0xffffff : this.colours.cloth);
    this.cloth.material = this.seen.clay && !fits ? this.clay : material;
    [this.key.intensity, this.fill.intensity] = fits ? [1, 2] : [2.7, 0.7]; // colours are read by even light
    if (fits) {
      const one = new THREE.Color(),
        linear = Float32Array.from(
          { length: 256 },
          (_, i) => one.setRGB(i / 255, 0, 0, THREE.SRGBColorSpace).r,
        );
      this.cloth.geometry.setAttribute(
        "color",
        new THREE.BufferAttribute(
          Float32Array.from(colours!, (c) => linear[c]),
          3,
        ),
      );
    }
    this.draw();
  }

  /** The cloth as it moves: strokes are drawn on it only where it has stopped. */
  move(positions: Float32Array) {
    if (!this.frame || positions.length !== this.frame.positions.length) return;
    this.colour(null);
    this.frame.positions.set(positions);
    this.picker.haveMoved();
    this.cloth.geometry.getAttribute("position").needsUpdate = true;
    this.cloth.geometry.computeVertexNormals();
    this.cloth.geometry.computeBoundingSphere();
    this.showWire();
    this.marks.clear();
    this.showPins();
    this.draw();
  }

  /** The body as it moves. */
  moveBody(positions: Float32Array) {
    const at = this.body.geometry.getAttribute("position") as THREE.BufferAttribute | undefined;
    if (!at || at.array.length !== positions.length) return;
    (at.array as Float32Array).set(positions);
    at.needsUpdate = true;
    this.body.geometry.computeVertexNormals();
    this.body.geometry.computeBoundingSphere();
    this.picker.haveMoved();
    this.draw();
  }

  see(seen: Seen) {
    if (seen.lines && !this.seen.lines) this.marks.renew(); // they are asked for: all are seen for a while
    this.seen = seen;
    this.body.visible = seen.body;
    this.marks.group.visible = seen.lines;
    this.cloth.material = seen.clay && !this.fabric.vertexColors ? this.clay : this.fabric;
    this.showWire();
    this.draw();
  }

  private showWire() {
    this.wire.visible = this.seen.wire;
    if (!this.seen.wire || !this.frame) return;
    this.wire.geometry.dispose();
    this.wire.geometry = new THREE.WireframeGeometry(this.cloth.geometry);
  }

  private showPins() {
    const { positions, pinned } = this.frame!;
    const points = new Float32Array(3 * pinned.length);
    pinned.forEach((v, i) => points.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
    this.pins.geometry.dispose();
    this.pins.geometry = new THREE.BufferGeometry();
    this.pins.geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  }

  /** Dots by which the chosen line is dragged. */
  showHandles(points: THREE.Vector3[]) {
    this.handles.visible = points.length > 0;
    this.handles.geometry.dispose();
    this.handles.geometry = new THREE.BufferGeometry().setFromPoints(points);
    this.draw();
  }

  /** The plane x = middle at which lines are mirrored; null: hidden. */
  showPlane(middle: number | null) {
    this.plane.visible = middle !== null && !!this.frame;
    if (middle !== null && this.frame) {
      const box = new THREE.Box3().setFromBufferAttribute(
        this.cloth.geometry.getAttribute("position") as THREE.BufferAttribute,
      );
      const size = box.getSize(new THREE.Vector3()),
        centre = box.getCenter(new THREE.Vector3());
      this.plane.geometry.dispose();
      this.plane.geometry = new THREE.PlaneGeometry(1.4 * size.z + 0.1 * this.size, 1.1 * size.y).rotateY(
        Math.PI / 2,
      );
      const edges = this.plane.children[0] as THREE.LineSegments;
      edges.geometry.dispose();
      edges.geometry = new THREE.EdgesGeometry(this.plane.geometry);
      this.plane.position.set(middle, centre.y, centre.z);
    }
    this.draw();
  }

  /** From the cloth that is pulled to the pointer; null: none. */
  showRope(ends: [THREE.Vector3, THREE.Vector3] | null) {
    this.rope.visible = ends !== null;
    if (ends) {
      this.rope.geometry.dispose();
      this.rope.geometry = new THREE.BufferGeometry().setFromPoints(ends);
    }
    this.draw();
  }

  /** Draws by `how` without lines, pins and dots, and then all as before. */
  private async withoutTools<T>(how: () => Promise<T>): Promise<T> {
    const tools = [
        this.marks.group,
        this.marks.signs,
        this.pins,
        this.handles,
        this.rope,
        this.plane,
        this.band,
      ],
      seen = tools.map((t) => t.visible);
    for (const tool of tools) tool.visible = false;
    try {
      return await how();
    } finally {
      tools.forEach((tool, i) => (tool.visible = seen[i]));
      this.draw();
    }
  }

  /** What is seen, twice as fine, as PNG. */
  picture(): Promise<Blob | null> {
    return this.withoutTools(() => {
      this.renderWith(Math.max(2, devicePixelRatio), true); // what was drawn before is gone from the canvas
      return new Promise((take) => this.canvas.toBlob(take));
    });
  }

  /** Squares of so many pixels of what is seen, by a camera of its own from so many places once round it. Nothing else is
   *  drawn meanwhile, nor by the pen. */
  round(count: number, side: number, take: (square: HTMLCanvasElement) => void): Promise<void> {
    const camera = this.camera.clone(),
      target = this.controls.target.clone(),
      from = camera.position.clone().sub(target);
    camera.aspect = 1;
    camera.updateProjectionMatrix();
    return this.withoutTools(async () => {
      this.isRecording = true;
      this.canvas.style.pointerEvents = "none";
      try {
        this.renderer.setPixelRatio(1);
        this.renderer.setSize(side, side, false);
        for (let i = 0; i < count; ++i) {
          const way = from.clone().applyAxisAngle(new THREE.Vector3(0, 1, 0), (-2 * Math.PI * i) / count);
          camera.position.copy(target).add(way);
          camera.lookAt(target);
          this.renderWith(1, true, camera);
          take(this.canvas);
          await new Promise((soon) => setTimeout(soon)); // the page stays alive
        }
      } finally {
        this.isRecording = false;
        this.canvas.style.pointerEvents = "";
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.fit();
      }
    });
  }

  /** Brings a point into the middle of the picture, and nearer. */
  lookAt(point: THREE.Vector3) {
    const way = this.camera.position.clone().sub(this.controls.target);
    this.controls.target.copy(point);
    this.camera.position.copy(point).addScaledVector(way.normalize(), 0.9 * this.size);
    this.controls.update();
    this.draw();
  }

  /** The band that a line would raise, while it is drawn; of no hits: none. */
  showBand(hits: Hit[], width: number, colour: number) {
    this.band.visible = hits.length > 1;
    if (hits.length > 1) {
      const points: number[] = [],
        faces: number[] = [];
      hits.forEach((hit, i) => {
        const along = hits[Math.min(i + 1, hits.length - 1)].shown
          .clone()
          .sub(hits[Math.max(i - 1, 0)].shown);
        const across = along.cross(hit.normal).normalize();
        const end = Math.min(i, hits.length - 1 - i) === 0 ? 0.35 : 1;
        for (const s of [-1, -0.12, 0.12, 1])
          points.push(
            ...hit.shown
              .clone()
              .addScaledVector(across, 0.5 * s * width * end)
              .addScaledVector(hit.normal, lift * this.size)
              .toArray(),
          );
        if (i === 0) return;
        for (let k = 0; k < 3; ++k) {
          const p = 4 * (i - 1) + k,
            q = p + 4;
          faces.push(p, q, p + 1, p + 1, q, q + 1);
        }
      });
      this.band.geometry.dispose();
      this.band.geometry = new THREE.BufferGeometry();
      this.band.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
      this.band.geometry.setIndex(faces);
      const material = this.band.material as THREE.MeshBasicMaterial;
      material.color.set(colour);
      material.polygonOffset = true;
      material.polygonOffsetFactor = material.polygonOffsetUnits = -4;
    }
    this.draw();
  }

  /** Looks at the cloth from where the camera is; where it does so already, at body and cloth. */
  frameAll() {
    this.look(undefined, !this.isWide && this.camera.position.equals(this.lookedFrom));
  }

  /** Looks at the whole cloth, and the body with it: from a side, or from where the camera is. */
  look(side?: Side, withBody = false) {
    if (!this.frame) return;
    const at = (mesh: THREE.Mesh) =>
      mesh.geometry.getAttribute("position") as THREE.BufferAttribute | undefined;
    const box = new THREE.Box3().setFromBufferAttribute(at(this.cloth)!),
      body = at(this.body);
    this.isWide = withBody && body !== undefined && this.seen.body;
    if (this.isWide) box.union(new THREE.Box3().setFromBufferAttribute(body!));
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const ways = { front: [0, 0.12, 1], back: [0, 0.12, -1], right: [1, 0.12, 0] };
    const way = side
      ? new THREE.Vector3(...ways[side])
      : this.camera.position.clone().sub(this.controls.target);
    const half = Math.atan(Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect));
    this.controls.target.copy(sphere.center);
    const distance = (1.05 * sphere.radius) / Math.sin(half);
    this.camera.position.copy(sphere.center).addScaledVector(way.normalize(), distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.lookedFrom.copy(this.camera.position);
    this.draw();
  }

  /** Turns the camera about the cloth [rad], and brings it nearer by a factor. */
  turn(right: number, up: number, nearer = 1) {
    const way = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    way.theta -= right;
    way.phi = Math.min(Math.max(way.phi - up, 0.02), Math.PI - 0.02);
    way.radius /= nearer;
    this.camera.position.setFromSpherical(way).add(this.controls.target);
    this.controls.update();
    this.draw();
  }
}
