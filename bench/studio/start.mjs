// SPDX-License-Identifier: GPL-3.0-or-later
// Starts a studio for a bench: on a garment, with a body or without, held by its upper border or not, in a folder of its own.
import { spawn } from "node:child_process";
import { resolve } from "node:path";

/** The program, and its address once it has printed it. */
export async function start(furrow, garment, body, folder, isHeld = true) {
  const program = spawn(resolve(furrow), ["studio", resolve(garment), ...(body ? ["--body", resolve(body)] : []), ...(isHeld ? ["--pin-loop", "top"] : []), "--no-browser"], { cwd: folder });
  const url = await new Promise((done, fail) => {
    let said = "";
    const hear = (data) => {
      const found = /http:\/\/\S+/.exec((said += data));
      if (found) done(found[0]);
    };
    program.stdout.on("data", hear);
    program.stderr.on("data", hear);
    program.on("exit", () => fail(new Error(said)));
  });
  return { program, url };
}
