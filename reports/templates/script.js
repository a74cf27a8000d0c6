// Sorts and filters the table of numbers. The page reads the same without it.
(() => {
  const table = document.getElementById("errors");
  if (!table) return;
  const body = table.tBodies[0];
  const filter = document.getElementById("filter");
  const verdict = document.getElementById("by-verdict");
  filter.closest(".controls").hidden = false;

  const apply = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of body.rows) {
      const text = row.textContent.toLowerCase();
      const named = words.every((word) => text.includes(word));
      row.hidden = !named || (verdict.value && row.dataset.verdict !== verdict.value);
    }
  };
  filter.addEventListener("input", apply);
  verdict.addEventListener("change", apply);

  const compare = (a, b) => {
    const [x, y] = [Number(a), Number(b)];
    return Number.isFinite(x) && Number.isFinite(y) ? x - y : a.localeCompare(b);
  };
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      [...table.tHead.rows[0].cells].forEach((cell) => cell.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const key = (row) => row.cells[column].dataset.sort;
      const rows = [...body.rows].sort((a, b) => compare(key(a), key(b)) * (down ? -1 : 1));
      body.append(...rows);
    });
  });
})();
