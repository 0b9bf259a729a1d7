// SPDX-License-Identifier: Apache-2.0
// Bundles the page into one HTML file that needs nothing else: node build.mjs OUT.html [ENGINE_FOLDER]
// With the folder of obvid_web.js and obvid_web.wasm the page holds its engine and needs no server.
import { readFileSync, writeFileSync, renameSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { build, transform } from "esbuild";

const out = process.argv[2] ?? "studio.html", engine = process.argv[3];
const here = new URL(".", import.meta.url).pathname;
const common = { bundle: true, minify: true, write: false, outdir: "unused", format: "iife", target: ["es2021"] };
const made = await build({
  ...common,
  entryPoints: [here + "src/main.tsx"],
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "inline",
});
const text = (ending) => made.outputFiles.find((f) => f.path.endsWith(ending))?.text ?? "";
const script = (code, attributes = "") => `<script${attributes}>${code.replaceAll("</script", "<\\/script")}</script>`;

async function engineParts() {
  const glue = await transform(readFileSync(engine + "/obvid_web.js", "utf8"), { minify: true, target: "es2021" });
  const worker = await build({ ...common, entryPoints: [here + "src/engine/worker.ts"] });
  const program = gzipSync(readFileSync(engine + "/obvid_web.wasm"), { level: 9 }).toString("base64");
  // Nothing but what is in the page: no request leaves it.
  const policy = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; " +
    "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";
  return {
    policy: `<meta http-equiv="Content-Security-Policy" content="${policy}">`,
    parts: script(glue.code + worker.outputFiles[0].text, ' type="text/plain" id="engine-script"') +
      script(program, ' type="text/plain" id="engine-program"'),
  };
}

const within = engine ? await engineParts() : { policy: "", parts: "" };
const page = readFileSync(here + "src/index.html", "utf8")
  .replace("<!-- policy -->\n", () => (within.policy ? within.policy + "\n" : ""))
  .replace("<!-- style -->", () => `<style>${text(".css")}</style>`)
  .replace("<!-- script -->", () => within.parts + script(text(".js")));
writeFileSync(out + ".part", page);
renameSync(out + ".part", out);
