// Tests of the report page in a real browser: node tests/browser/check.mjs REPORT.html
// Exit code 0: all passed, 1: findings, 77: there is no browser.
import { statSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import * as audit from "./audit.mjs";
import { Browser, installed } from "./browser.mjs";

const SECTIONS = ["answer", "claims", "numbers", "bias", "budget", "cost", "cases", "provenance", "machine"];
const WIDTHS = [400, 1000, 1600];
const MOST_BYTES = 3e6;

const file = process.argv[2];
if (!file) {
  console.error("usage: node tests/browser/check.mjs REPORT.html");
  process.exit(2);
}
const name = installed();
if (!name) {
  console.error("no browser: install chromium, or name one in SEAM_BROWSER");
  process.exit(77);
}

const findings = [];
const report = (what, list) => {
  console.log(`${list.length ? "FAILED" : "ok    "} ${what}`);
  list.slice(0, 8).forEach((finding) => console.log(`       ${finding}`));
  if (list.length > 8) console.log(`       and ${list.length - 8} more`);
  findings.push(...list);
};

const url = pathToFileURL(resolve(file)).href;
const bytes = statSync(file).size;
report(`the page has ${(bytes / 1e6).toFixed(2)} MB of at most 3`, bytes < MOST_BYTES ? [] : [`${bytes} bytes`]);
const browser = await Browser.start(name);
try {
  await browser.show({ width: 1000 });
  const { requests, errors } = await browser.open(url);
  report("it loads without errors", errors);
  report("it asks the network for nothing", requests.filter((request) => request !== url));
  await keyboard();
  await browser.run(audit.openAll);
  report("landmarks, headers and alternatives are there", await browser.run(audit.structure, SECTIONS));
  await filtering();
  await sorting();
  for (const width of WIDTHS) {
    await browser.show({ width });
    report(`nothing sticks out at ${width} px`, await browser.run(audit.outside));
    report(`no text lies on another at ${width} px`, await browser.run(audit.overlaps));
  }
  for (const scheme of ["light", "dark"]) {
    await browser.show({ width: 1000, scheme });
    report(`everything can be read in ${scheme}`, await browser.run(audit.faint));
  }
  await printing();
} finally {
  await browser.stop();
}
process.exit(findings.length ? 1 : 0);

/** The first stop of a keyboard is the way past the contents; what has the focus can be seen. */
async function keyboard() {
  const list = [];
  const focus = () => browser.run(() => {
    const e = document.activeElement;
    return { name: e.className || e.tagName, outline: getComputedStyle(e).outlineStyle, left: e.getBoundingClientRect().left };
  });
  for (const step of ["skip", "brand"]) {
    await browser.press("Tab");
    const at = await focus();
    if (at.name !== step) list.push(`Tab leads to ${at.name}, not to ${step}`);
    if (at.outline === "none" || at.left < 0) list.push(`the focus on ${at.name} cannot be seen`);
  }
  report("a keyboard gets about and is seen to", list);
}

/** Words and choices leave exactly the rows that have them, and say how many. */
async function filtering() {
  const list = await browser.run(() => {
    const found = [];
    const set = (id, value) => {
      const field = document.getElementById(id);
      field.value = value;
      field.dispatchEvent(new Event(field.tagName === "SELECT" ? "change" : "input"));
    };
    const rows = [...document.getElementById("errors").tBodies[0].rows];
    const shown = () => rows.filter((row) => row.checkVisibility());
    const expect = (what, test) => {
      const wanted = rows.filter(test);
      const now = shown();
      if (now.length !== wanted.length || !wanted.every((row) => now.includes(row))) found.push(`${what}: ${now.length} rows shown, ${wanted.length} fit`);
      if (!document.getElementById("shown").textContent.startsWith(`${now.length} of ${rows.length} `)) found.push(`${what}: the count is not told`);
    };
    const has = (word) => (row) => row.textContent.toLowerCase().includes(word);
    const word = rows[0].querySelector("a").textContent;
    expect("no filter", () => true);
    set("filter", `${word.toUpperCase()} pass`);
    expect("two words", (row) => has(word)(row) && has("pass")(row));
    set("filter", "no such quantity");
    expect("nothing fits", () => false);
    set("filter", "");
    set("by-verdict", "shown");
    expect("a verdict", (row) => row.dataset.verdict === "shown");
    set("by-verdict", "");
    set("by-activity", "benchmarking");
    expect("a kind of evidence", (row) => row.dataset.activity === "benchmarking");
    set("by-activity", "");
    expect("filters taken back", () => true);
    return found;
  });
  report("the numbers can be filtered", list);
}

/** Each heading sorts both ways and says so. */
async function sorting() {
  const list = await browser.run(() => {
    const found = [];
    const table = document.getElementById("errors");
    const heads = [...table.tHead.rows[0].cells];
    const before = table.tBodies[0].rows.length;
    heads.forEach((head, column) => {
      for (const direction of ["ascending", "descending"]) {
        head.querySelector("button").click();
        if (head.getAttribute("aria-sort") !== direction || heads.filter((h) => h.hasAttribute("aria-sort")).length !== 1) found.push(`${head.textContent}: aria-sort is not ${direction}`);
        const keys = [...table.tBodies[0].rows].map((row) => row.cells[column].dataset.sort);
        const numbers = keys.map(Number);
        const plain = numbers.every(Number.isFinite);
        const order = (k) => (plain ? numbers[k] - numbers[k - 1] : keys[k].localeCompare(keys[k - 1]));
        const sign = direction === "ascending" ? 1 : -1;
        if (!keys.every((_, k) => k === 0 || sign * order(k) >= 0)) found.push(`${head.textContent} is not sorted ${direction}`);
      }
    });
    if (table.tBodies[0].rows.length !== before) found.push("sorting loses rows");
    heads[0].querySelector("button").click();
    return found;
  });
  report("the numbers can be sorted", list);
}

/** On paper everything is open, and nothing that needs a screen is there. */
async function printing() {
  await browser.show({ width: 1000, media: "print" });
  const list = await browser.run(() => {
    const seen = (selector) => [...document.querySelectorAll(selector)].some((e) => e.checkVisibility());
    const found = ["nav", ".controls", ".skip"].filter(seen).map((selector) => `${selector} is printed`);
    for (const tall of document.querySelectorAll(".tall")) if (tall.scrollHeight > tall.clientHeight + 1) found.push("a table is cut off");
    return found;
  });
  const { data } = await browser.send("Page.printToPDF", { preferCSSPageSize: true });
  if (Buffer.from(data, "base64").subarray(0, 5).toString() !== "%PDF-") list.push("no PDF comes out");
  report("it prints", list);
}
