// SPDX-License-Identifier: GPL-3.0-or-later
// node check_glb.cjs [--like SOURCE.glb] FILE.glb …: fails on any error or warning of the Khronos validator, but for the
// codes of warnings that it has for SOURCE.glb, too.
const fs = require("fs");
const validator = require("gltf-validator");

const judged = (path) => validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { maxIssues: 200 });
const isWarning = (message) => message.severity === 1;

async function main() {
  let paths = process.argv.slice(2), bad = 0, known = [];
  if (paths[0] === "--like") {
    known = (await judged(paths[1])).issues.messages.filter(isWarning).map((m) => m.code);
    paths = paths.slice(2);
  }
  for (const path of paths) {
    const report = await judged(path);
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    bad += numErrors + numWarnings - messages.filter((m) => isWarning(m) && known.includes(m.code)).length;
    console.log(
      `RESULT ${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints; ` +
        `${report.info.totalVertexCount} vertices, ${report.info.totalTriangleCount} triangles, ` +
        `morph targets: ${report.info.hasMorphTargets}, validator ${report.validatorVersion}`);
    for (const m of messages.slice(0, 20)) console.log(`  ${m.code}: ${m.message} (${m.pointer})`);
  }
  process.exit(bad || paths.length === 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
