// Breaks a good report page in every way the check looks for, and expects each to be found:
// node tests/browser/defects.mjs REPORT.html [WORD]   (only those with the word in their name)
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const replace = (from, to) => (page) => {
  if (!page.includes(from)) throw new Error(`the page has no '${from}'`);
  return page.replace(from, to);
};
const before = (from, what) => replace(from, what + from);

// What is done to the page, and the line of the check that must fail.
const DEFECTS = [
  ["something is loaded", before("</main>", `<img alt="" src="http://127.0.0.1:9/x.png">`), "asks the network"],
  ["a script fails", before("</body>", "<script>missing();</script>"), "loads without errors"],
  ["the way past the contents is gone", replace(`class="skip"`, `class="brand"`), "a keyboard gets about"],
  ["a section is gone", replace(`<section id="bias"`, `<section id="other"`), "landmarks"],
  ["a figure has no alternative", replace(/<desc>[^<]*<\/desc>/.exec(readFileSync(process.argv[2], "utf8"))[0], ""), "landmarks"],
  ["a header has no scope", replace(`<th scope="row"`, "<th"), "landmarks"],
  ["the filter looks at one word only", replace("words.every", "words.some"), "filtered"],
  ["a column sorts by nothing", replace("compare(key(a), key(b))", "0"), "sorted"],
  ["something is too wide", before("</main>", `<p style="width:2000px">wide</p>`), "sticks out at 400 px"],
  ["two texts lie on each other", before("</main>", `<p>above</p><p style="margin-top:-2.1em">below</p>`), "no text lies on another"],
  ["a text is faint", before("</main>", `<p style="color:#aaa">faint</p>`), "read in light"],
  ["a text is faint in the dark", before("</main>", `<p style="color:#222">faint</p>`), "read in dark"],
  ["the contents are printed", before("</body>", "<style>@media print { nav { display: flex !important; } }</style>"), "it prints"],
];

const good = readFileSync(process.argv[2], "utf8");
const check = join(dirname(fileURLToPath(import.meta.url)), "check.mjs");
const folder = mkdtempSync(join(tmpdir(), "seam-defects-"));
let missed = 0;
const chosen = DEFECTS.filter(([name]) => name.includes(process.argv[3] ?? ""));
if (!chosen.length) throw new Error(`no defect has '${process.argv[3]}' in its name`);
for (const [name, defect, line] of chosen) {
  const file = join(folder, "report.html");
  writeFileSync(file, defect(good));
  const { status, stdout } = spawnSync(process.execPath, [check, file], { encoding: "utf8" });
  const found = status === 1 && stdout.split("\n").some((l) => l.startsWith("FAILED") && l.includes(line));
  console.log(`${found ? "found " : "MISSED"} ${name}`);
  missed += !found;
}
rmSync(folder, { recursive: true });
process.exit(missed ? 1 : 0);
