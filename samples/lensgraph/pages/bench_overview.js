// The overview over all shots: a small chart of each, and one figure of every variant on every shot as a table.

function drawCards(box, view, chosen, choose) {
  box.replaceChildren();
  shots.forEach((shot, index) => {
    const card = element(box, "button", { type: "button", class: "card", "data-shot": index,
      "aria-pressed": index === chosen });
    element(card, "b", {}, shot.name || shot.id);
    element(card, "span", { class: "quiet" }, `${shot.width} × ${shot.height}`);
    const chart = element(card, "div");
    card.addEventListener("click", () => choose(index));
    drawToWidth(chart, width => drawSmallChart(chart, shot, view, width));
  });
}

/// Figures that the table can show: {id, text, of(result, shot), show(value), better}.
const matrixFigures = [
  ...timeAxes.filter(axis => axis.unit === "×").map(axis => ({ id: axis.id, text: axis.text, better: -1,
    isToAccumulation: axis.isToAccumulation, show: brief,
    of: (result, shot) => { const time = axis.of(result, shot); return time ? time.median : null; } })),
  ...qualityAxes.map(axis => ({ id: axis.id, text: axis.text, better: axis.better,
    show: value => fixed(value, axis.digits), of: result => qualityOf(result, axis, "") })),
];

/// A row per variant, in the order of the file; a column per shot.
function matrixRows() {
  const rows = new Map();
  shots.forEach((shot, index) => {
    for (const result of shot.results) {
      if (!rows.has(result.key)) rows.set(result.key, { key: result.key, result, inShot: [] });
      rows.get(result.key).inShot[index] = result;
    }
  });
  return [...rows.values()];
}

function geometricMean(values) {
  const positive = values.filter(value => value > 0 && Number.isFinite(value));
  return positive.length && positive.length === values.length ? Math.exp(d3.mean(positive.map(Math.log))) : null;
}

function matrixColumns(figure, view) {
  const valueIn = (row, index) => row.inShot[index] ? figure.of(row.inShot[index], shots[index]) : null;
  const rows = matrixRows()
    .filter(row => view.techniques.has(row.result.technique) && view.programs.has(row.result.program));
  const meanOf = row => {
    const values = shots.map((_, index) => valueIn(row, index));
    if (values.some(value => value === null)) return null;
    const isRatio = figure.better < 0 && !["flip", "relativeRmse", "maxError"].includes(figure.id);
    return isRatio ? geometricMean(values) : d3.mean(values);
  };
  const column = (name, title, value) => {
    const all = rows.map(value).filter(v => v !== null), best = figure.better > 0 ? d3.max(all) : d3.min(all);
    return { name, title, value, text: row => figure.show(value(row)),
      tone: row => {
        const v = value(row);
        if (v === null) return "";
        return (v === best ? "best " : "") + (figure.isToAccumulation && v < 1 ? "ahead" : "");
      } };
  };
  const columns = [{ name: "variant", isText: true, value: row => nameOf(row.result), text: row => nameOf(row.result) },
    column("mean", "over all shots; geometric for times; none where a shot has no figure", meanOf),
    ...shots.map((shot, index) => column(shotName(shot), shot.file || "", row => valueIn(row, index)))];
  return { columns, rows };
}
