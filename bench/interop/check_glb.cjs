// SPDX-License-Identifier: GPL-3.0-or-later
// node check_glb.cjs FILE.glb …: fails on any error or warning of the Khronos validator.
const fs = require("fs");
const validator = require("gltf-validator");

async function main() {
  let bad = 0;
  for (const path of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { maxIssues: 20 });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    bad += numErrors + numWarnings;
    console.log(
      `RESULT ${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints; ` +
        `${report.info.totalVertexCount} vertices, ${report.info.totalTriangleCount} triangles, ` +
        `morph targets: ${report.info.hasMorphTargets}, validator ${report.validatorVersion}`);
    for (const m of messages) console.log(`  ${m.code}: ${m.message} (${m.pointer})`);
  }
  process.exit(bad || process.argv.length < 3 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
