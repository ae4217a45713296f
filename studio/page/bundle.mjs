// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page and writes it as one C++ source, page_files.cpp, with the licences of what is in it.
import { build } from "esbuild";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const parts = ["three", "three-mesh-bvh", "preact"];

const licences = parts.map((name) => {
  const folder = `node_modules/${name}`;
  const { version } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const file = ["LICENSE", "LICENSE.md", "LICENSE.txt"].map((f) => `${folder}/${f}`).find(existsSync);
  if (!file) throw new Error(`${name} has no licence file`);
  return `${name} ${version}\n\n${readFileSync(file, "utf8").trim()}\n`;
});
const licenceText = "The page of furrow studio holds these libraries.\n\n" + licences.join("\n---\n\n");
writeFileSync("licences.txt", licenceText);

const bundled = await build({
  entryPoints: ["src/main.tsx"], bundle: true, minify: true, write: false, format: "iife", target: "es2021",
  legalComments: "none", define: { "process.env.NODE_ENV": '"production"' }, logLevel: "warning",
});
const code = "/* Licences of the libraries inside: /licences.txt */\n" + bundled.outputFiles[0].text;

// Octal escapes of three digits each: a longer one would take the next character along.
const literal = (bytes) => {
  const lines = [];
  for (let at = 0; at < bytes.length; at += 64)
    lines.push('    "' + [...bytes.subarray(at, at + 64)].map((b) => "\\" + b.toString(8).padStart(3, "0")).join("") + '"');
  return lines.join("\n");
};
const files = [
  ["/", "text/html; charset=utf-8", Buffer.from(readFileSync("index.html")), false],
  ["/app.js", "text/javascript; charset=utf-8", Buffer.from(code), true],
  ["/app.css", "text/css; charset=utf-8", Buffer.from(readFileSync("app.css")), true],
  ["/again.js", "text/javascript; charset=utf-8", Buffer.from(readFileSync("again.js")), false],
  ["/licences.txt", "text/plain; charset=utf-8", Buffer.from(licenceText), true],
].map(([path, type, bytes, zipped]) => {
  const sent = zipped ? gzipSync(bytes, { level: 9 }) : bytes;
  return `    {"${path}", "${type}", std::string_view(\n${literal(sent)}, ${sent.length}), ${zipped}},`;
});
writeFileSync("page_files.cpp", `// Made by studio/page/bundle.mjs.
#include "studio/page_files.h"

namespace furrow::studio {
namespace {
constexpr PageFile page_files[] = {
${files.join("\n")}
};
}  // namespace

const PageFile* find_page_file(std::string_view path) {
  for (const PageFile& file : page_files)
    if (file.path == path) return &file;
  return nullptr;
}

}  // namespace furrow::studio
`);
console.log(`app.js: ${code.length} bytes, ${gzipSync(code, { level: 9 }).length} gzipped`);
