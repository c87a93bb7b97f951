// A table that sorts by the column whose heading is pressed, and whose rows can be selected by mouse and keyboard.

/// Columns: {name, title, isText, value(row), text(row), more(row), tone(row)}: the value sorts, absent values (null) last;
/// `more` is a second, quiet line, `tone` the cell's classes. Rows need a unique `key`. `select(row)` is called when a
/// row is chosen; null: rows cannot be.
/// Returns {mark(key), setColumns(columns), setRows(rows)}.
function sortableTable(table, label, select) {
  let columns = [], rows = [], sortedBy = null, isUp = true, marked = null;
  table.setAttribute("aria-label", label);
  if (select) table.setAttribute("role", "grid");
  const head = element(element(table, "thead"), "tr"), body = element(table, "tbody");

  function ordered() {
    const column = columns.find(c => c.name === sortedBy);
    if (!column) return rows;
    const isAbsent = value => value === null || value === undefined;
    return [...rows].sort((a, b) => {
      const [x, y] = [column.value(a), column.value(b)];
      if (isAbsent(x) || isAbsent(y)) return isAbsent(x) - isAbsent(y);
      return (isUp ? 1 : -1) * (x < y ? -1 : x > y ? 1 : 0);
    });
  }

  function drawRow(row) {
    const line = element(body, "tr", { "data-key": row.key });
    if (select) {
      line.tabIndex = 0;
      line.setAttribute("aria-selected", row.key === marked);
      line.addEventListener("click", () => select(row));
      line.addEventListener("keydown", event => {
        if (event.key === "Enter" || event.key === " ") { event.preventDefault(); select(row); }
        const next = event.key === "ArrowDown" ? line.nextSibling
          : event.key === "ArrowUp" ? line.previousSibling : null;
        if (next) { event.preventDefault(); next.focus(); }
      });
    }
    columns.forEach((column, i) => {
      const tone = column.tone ? column.tone(row) : "";
      const cell = element(line, "td", { class: `${column.isText ? "text" : ""}${i === 0 ? " first" : ""} ${tone}` },
        column.text(row));
      const more = column.more ? column.more(row) : null;
      if (more) element(cell, "small", {}, more);
    });
  }

  function draw() {
    head.replaceChildren();
    columns.forEach((column, i) => {
      const isSorted = column.name === sortedBy;
      const cell = element(head, "th", { scope: "col", class: `${column.isText ? "text" : ""}${i === 0 ? " first" : ""}`,
        "aria-sort": isSorted ? (isUp ? "ascending" : "descending") : "none" });
      const button = element(cell, "button", { type: "button", "data-column": column.name }, column.name);
      if (column.title) button.title = column.title;
      button.addEventListener("click", () => {
        isUp = isSorted ? !isUp : true;
        sortedBy = column.name;
        draw();
        head.children[i].firstChild.focus();
      });
    });
    body.replaceChildren();
    ordered().forEach(drawRow);
  }

  return {
    mark(key) {
      marked = key;
      for (const line of body.children) line.setAttribute("aria-selected", line.dataset.key === key);
    },
    setColumns(list) { columns = list; draw(); },
    setRows(list) { rows = list; draw(); },
  };
}
