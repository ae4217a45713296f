// SPDX-License-Identifier: GPL-3.0-or-later
// The light of a cloth that is looked at for its shape alone.
import * as THREE from "three";

const side = 128; // [pixels]

/** What a ball of clay looks like by a lamp from the upper left and a weak one from the right, for surfaces that take
 *  their light from where they face: it turns with the camera, and costs no shadows. */
export function clayTexture(): THREE.DataTexture {
  const bytes = new Uint8Array(4 * side * side),
    lamp = new THREE.Vector3(-0.8, 0.45, 0.4).normalize(),
    rim = new THREE.Vector3(0.95, -0.1, 0.3).normalize(),
    normal = new THREE.Vector3();
  for (let i = 0; i < side * side; ++i) {
    normal.set((2 * ((i % side) + 0.5)) / side - 1, (2 * (Math.floor(i / side) + 0.5)) / side - 1, 0);
    normal.z = Math.sqrt(Math.max(0, 1 - normal.lengthSq()));
    const light = 0.2 + 0.78 * Math.max(0, normal.dot(lamp)),
      edge = 0.18 * Math.max(0, normal.dot(rim));
    [1, 0.88, 0.78].forEach((share, k) => (bytes[4 * i + k] = 255 * Math.min(1, light * share + edge)));
    bytes[4 * i + 3] = 255;
  }
  const texture = new THREE.DataTexture(bytes, side, side);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
