// Sorts and filters the table of numbers, and opens cases. The page reads the same without it.
(() => {
  const cases = [...document.querySelectorAll("details.case")];
  const reveal = () => {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const closed = target && target.closest("details:not([open])");
    if (closed) {
      closed.open = true;
      target.scrollIntoView();
    }
  };
  addEventListener("hashchange", reveal);
  reveal();
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((d) => (d.open = true)));

  const all = document.getElementById("open-cases");
  if (all) {
    all.closest(".controls").hidden = false;
    all.addEventListener("click", () => {
      const open = cases.some((c) => !c.open);
      cases.forEach((c) => (c.open = open));
      all.textContent = open ? "Close all cases" : "Open all cases";
    });
  }

  const table = document.getElementById("errors");
  if (!table) return;
  const body = table.tBodies[0];
  const filter = document.getElementById("filter");
  const verdict = document.getElementById("by-verdict");
  const activity = document.getElementById("by-activity");
  const shown = document.getElementById("shown");
  filter.closest(".controls").hidden = false;

  const texts = new Map([...body.rows].map((row) => [row, row.textContent.toLowerCase()]));
  const apply = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted = (select, value) => !select.value || select.value === value;
    let count = 0;
    for (const [row, text] of texts) {
      const named = words.every((word) => text.includes(word));
      row.hidden = !(named && wanted(verdict, row.dataset.verdict) && wanted(activity, row.dataset.activity));
      count += !row.hidden;
    }
    shown.textContent = `${count} of ${texts.size} numbers`;
  };
  filter.addEventListener("input", apply);
  verdict.addEventListener("change", apply);
  activity.addEventListener("change", apply);
  apply();

  const compare = (a, b) => {
    const [x, y] = [Number(a), Number(b)];
    return Number.isFinite(x) && Number.isFinite(y) ? x - y : a.localeCompare(b);
  };
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((cell) => cell.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const key = (row) => row.cells[column].dataset.sort;
      const rows = [...body.rows].sort((a, b) => compare(key(a), key(b)) * (down ? -1 : 1));
      body.append(...rows);
    });
  });
})();
