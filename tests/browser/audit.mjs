// What is looked at inside the page. Each function runs in the browser and gives a list of findings.

/** Opens everything that can be opened. */
export const openAll = () => {
  document.querySelectorAll("details").forEach((d) => (d.open = true));
};

/** Landmarks, names and headers that a screen reader needs. */
export const structure = (wanted) => {
  const found = [];
  const one = (selector) => {
    const count = document.querySelectorAll(selector).length;
    if (count !== 1) found.push(`${count} of ${selector}`);
  };
  ["h1", "main", "nav[aria-label]", "html[lang]", "head > title"].forEach(one);
  for (const id of wanted) {
    const part = document.getElementById(id);
    if (!part) found.push(`no section #${id}`);
    else if (!part.textContent.trim()) found.push(`#${id} is empty`);
  }
  for (const section of document.querySelectorAll("main > section")) {
    const name = document.getElementById(section.getAttribute("aria-labelledby"));
    if (!name) found.push(`section #${section.id} has no name`);
    if (!document.querySelector(`nav a[href="#${section.id}"]`)) found.push(`#${section.id} is not in the contents`);
  }
  let last = 1;
  for (const heading of document.querySelectorAll("h1, h2, h3, h4")) {
    const level = Number(heading.tagName[1]);
    if (level > last + 1) found.push(`h${level} '${heading.textContent}' follows h${last}`);
    last = level;
  }
  for (const svg of document.querySelectorAll("svg")) {
    const text = (name) => svg.querySelector(`:scope > ${name}`)?.textContent.trim();
    if (svg.getAttribute("role") !== "img" || !text("title") || !text("desc"))
      found.push(`figure without an alternative: ${svg.closest("figure")?.textContent.trim().slice(0, 60)}`);
  }
  for (const head of document.querySelectorAll("th")) if (!head.scope && !head.ariaHidden) found.push(`th without scope: ${head.textContent}`);
  for (const table of document.querySelectorAll("table")) if (!table.querySelector("thead th")) found.push(`table without headers: ${table.textContent.slice(0, 60)}`);
  for (const field of document.querySelectorAll("input, select, button")) if (!field.ariaLabel && !field.textContent.trim()) found.push(`field without a name: #${field.id}`);
  const ids = [...document.querySelectorAll("[id]")].map((e) => e.id);
  ids.filter((id, k) => ids.indexOf(id) !== k).forEach((id) => found.push(`id '${id}' twice`));
  return found;
};

/** Things that stick out of the page or of their figure. */
export const outside = () => {
  const found = [];
  const page = document.scrollingElement;
  if (page.scrollWidth > page.clientWidth) {
    const wide = [...document.querySelectorAll("body *")].filter((e) => !e.closest(".scroll, nav, .skip, pre, svg") && e.getBoundingClientRect().right > page.clientWidth + 1);
    found.push(`the page scrolls sideways by ${page.scrollWidth - page.clientWidth} px: ${wide.slice(0, 3).map((e) => `${e.tagName}.${e.className} '${e.textContent.trim().slice(0, 40)}'`).join("; ")}`);
  }
  for (const text of document.querySelectorAll("svg text")) {
    if (!text.textContent.trim()) found.push(`an empty text in ${text.closest("figure").querySelector("figcaption").textContent}`);
    const [inner, outer] = [text.getBoundingClientRect(), text.ownerSVGElement.getBoundingClientRect()];
    const out = Math.max(outer.left - inner.left, inner.right - outer.right, outer.top - inner.top, inner.bottom - outer.bottom);
    if (outer.width && out > 3) found.push(`'${text.textContent}' leaves its figure by ${out.toFixed(0)} px: ${text.closest("figure").querySelector("figcaption").textContent}`);
  }
  return found;
};

/** Pairs of texts that lie on each other. */
export const overlaps = () => {
  // The part of a rectangle that no ancestor clips away.
  const clipped = (rect, element) => {
    let [left, top, right, bottom] = [rect.left, rect.top, rect.right, rect.bottom];
    for (let e = element; e && e !== document.body; e = e.parentElement) {
      if (e instanceof SVGElement && !(e instanceof SVGSVGElement)) continue;
      const style = getComputedStyle(e);
      if (style.overflowX === "visible" && style.overflowY === "visible") continue;
      const box = e.getBoundingClientRect();
      [left, top, right, bottom] = [Math.max(left, box.left), Math.max(top, box.top), Math.min(right, box.right), Math.min(bottom, box.bottom)];
    }
    return { left, top, right, bottom };
  };
  const boxes = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode;
    const element = node.parentElement;
    if (!node.textContent.trim() || element.closest("script, style, title, desc, .skip, option")) continue;
    if (!element.checkVisibility()) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    const rects = element instanceof SVGElement ? [element.getBoundingClientRect()] : [...range.getClientRects()];
    for (const rect of rects) {
      const box = clipped(rect, element);
      if (box.right - box.left > 1 && box.bottom - box.top > 1) boxes.push({ ...box, node, element });
    }
  }
  boxes.sort((a, b) => a.top - b.top);
  const found = [];
  for (let i = 0; i < boxes.length; i++) {
    const a = boxes[i];
    for (let j = i + 1; j < boxes.length && boxes[j].top < a.bottom - 2; j++) {
      const b = boxes[j];
      if (a.node === b.node) continue;
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      // Line boxes of neighbouring lines touch; letters that lie on each other share most of a line's height.
      const line = Math.min(a.bottom - a.top, b.bottom - b.top);
      if (wide > 2 && high > 0.45 * line) {
        const where = a.element.closest("figure")?.querySelector("figcaption")?.textContent ?? a.element.closest("section")?.id;
        found.push(`'${a.node.textContent.trim().slice(0, 40)}' and '${b.node.textContent.trim().slice(0, 40)}' in ${where}`);
      }
    }
  }
  return found;
};

/** Texts whose contrast with what lies behind them is below 4.5 to 1 (3 to 1 for large ones; WCAG 2.2, 1.4.3). */
export const faint = () => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const known = new Map();
  const rgba = (colour) => {
    if (!known.has(colour)) {
      canvas.clearRect(0, 0, 1, 1);
      canvas.fillStyle = colour;
      canvas.fillRect(0, 0, 1, 1);
      known.set(colour, [...canvas.getImageData(0, 0, 1, 1).data]);
    }
    return known.get(colour);
  };
  const light = (c) => {
    const [r, g, b] = c.map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = rgba(getComputedStyle(e).backgroundColor);
      if (colour[3] === 255) return colour;
    }
    return [255, 255, 255, 255];
  };
  const found = new Set();
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent.trim());
    if (!own || element.closest("script, style, title, desc, option") || !element.checkVisibility()) continue;
    const style = getComputedStyle(element);
    const [a, b] = [rgba(element instanceof SVGElement ? style.fill : style.color), behind(element)].map((c) => light(c.slice(0, 3)));
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio < (large ? 3 : 4.5)) found.add(`${ratio.toFixed(2)} to 1: ${element.tagName.toLowerCase()}.${element.getAttribute("class") ?? ""} '${element.textContent.trim().slice(0, 30)}'`);
  }
  return [...found];
};
