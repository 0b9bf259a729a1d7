// SPDX-License-Identifier: Apache-2.0
// Bundles the page into one HTML file that needs nothing else: node build.mjs OUT.html
import { readFileSync, writeFileSync, renameSync } from "node:fs";
import { build } from "esbuild";

const out = process.argv[2] ?? "studio.html";
const here = new URL(".", import.meta.url).pathname;
const made = await build({
  entryPoints: [here + "src/main.tsx"],
  bundle: true,
  minify: true,
  write: false,
  outdir: "unused",
  format: "iife",
  target: ["es2021"],
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "inline",
});
const text = (ending) => made.outputFiles.find((f) => f.path.endsWith(ending))?.text ?? "";
const page = readFileSync(here + "src/index.html", "utf8")
  .replace("<!-- style -->", () => `<style>${text(".css")}</style>`)
  .replace("<!-- script -->", () => `<script>${text(".js").replaceAll("</script", "<\\/script")}</script>`);
writeFileSync(out + ".part", page);
renameSync(out + ".part", out);
