// Chromium over a pair of pipes: the DevTools protocol without any dependency.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const NAMES = [process.env.SEAM_BROWSER, "chromium", "chromium-browser", "google-chrome"].filter(Boolean);
const QUIET = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--remote-debugging-pipe"];

/** The first browser that is installed, or undefined. */
export const installed = () => NAMES.find((name) => spawnSync(name, ["--version"]).status === 0);

/** A running browser with one page. */
export class Browser {
  #process; #home; #session; #text = ""; #next = 1; #waiting = new Map(); #listeners = [];

  static async start(name) {
    const browser = new Browser();
    browser.#home = mkdtempSync(join(tmpdir(), "seam-browser-"));
    browser.#process = spawn(name, [...QUIET, `--user-data-dir=${browser.#home}`, "about:blank"],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.#process.stdio[4].on("data", (bytes) => browser.#read(bytes));
    const { targetInfos } = await browser.send("Target.getTargets");
    const { targetId } = targetInfos.find((target) => target.type === "page");
    const { sessionId } = await browser.send("Target.attachToTarget", { targetId, flatten: true });
    browser.#session = sessionId;
    for (const domain of ["Page", "Runtime", "Network", "Log"]) await browser.send(`${domain}.enable`);
    return browser;
  }

  /** Calls a method of the protocol. */
  send(method, params = {}) {
    const id = this.#next++;
    this.#process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.#session }) + "\0");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject, method }));
  }

  /** Runs a function in the page and gives what it returns. */
  async run(body, ...values) {
    const expression = `(${body})(...${JSON.stringify(values)})`;
    const { result, exceptionDetails } = await this.send("Runtime.evaluate",
      { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Opens an address and waits until it is loaded; gives the requests and errors on the way. */
  async open(url) {
    const [requests, errors] = [[], []];
    let loaded;
    const done = new Promise((resolve) => (loaded = resolve));
    this.#listeners = [({ method, params }) => {
      if (method === "Network.requestWillBeSent") requests.push(params.request.url);
      if (method === "Runtime.exceptionThrown") errors.push(params.exceptionDetails.exception?.description);
      if (method === "Log.entryAdded" && params.entry.level === "error") errors.push(params.entry.text);
      if (method === "Page.loadEventFired") loaded();
    }];
    await this.send("Page.navigate", { url });
    await done;
    return { requests, errors };
  }

  /** Sets the width of the window, light or dark, screen or print. */
  async show({ width, scheme = "light", media = "screen" }) {
    const size = { width, height: 900, deviceScaleFactor: 1, mobile: false };
    await this.send("Emulation.setDeviceMetricsOverride", size);
    const features = [{ name: "prefers-color-scheme", value: scheme }];
    await this.send("Emulation.setEmulatedMedia", { media, features });
  }

  /** Presses a key. */
  async press(key) {
    const params = { key, code: key, windowsVirtualKeyCode: key === "Tab" ? 9 : 13 };
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", ...params });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...params });
  }

  /** Ends this browser and removes its profile. */
  async stop() {
    const ended = new Promise((resolve) => this.#process.on("exit", resolve));
    this.#process.kill();
    await ended;
    rmSync(this.#home, { recursive: true, force: true, maxRetries: 5 });
  }

  #read(bytes) {
    const parts = (this.#text + bytes).split("\0");
    this.#text = parts.pop();
    for (const message of parts.map((part) => JSON.parse(part))) {
      const call = this.#waiting.get(message.id);
      this.#waiting.delete(message.id);
      if (!call) this.#listeners.forEach((listen) => listen(message));
      else if (message.error) call.reject(new Error(`${call.method}: ${message.error.message}`));
      else call.resolve(message.result);
    }
  }
}
