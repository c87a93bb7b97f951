// The page of a bench: head, controls, the chosen shot and variant, and what they show.

const view = { time: timeAxes[0], quality: qualityAxes[0], mask: "", techniques: new Set(techniques),
  programs: new Set(programs) };
const byId = id => document.getElementById(id);
let shotIndex = 0, selectedKey = null;
const shotOf = () => shots[shotIndex];
const selectedResult = () => shotOf().results.find(result => result.key === selectedKey);

// ---- Head

function drawHead() {
  document.title = `${bench.name} – bench`;
  byId("title").textContent = `Bench ${bench.name}`;
  addThemeButton(byId("head"));
  const facts = byId("facts"), device = bench.device || {}, host = bench.host || {}, settings = bench.settings || {};
  fact(facts, "device", device.type ? `${device.name} (${device.type})` : device.name || kNone);
  fact(facts, "driver", device.driver || kNone);
  fact(facts, "host", `${host.processor || kNone}, ${host.cores || "?"} cores`);
  fact(facts, "date", bench.date || kNone);
  fact(facts, "repeats", settings.repeats ?? kNone);
  fact(facts, "exposure", `${settings.exposureEv ?? 0} EV`);
  if (settings.referenceSamples) fact(facts, "reference", `${settings.referenceSamples} lens samples`);
  for (const program of bench.programs) {
    fact(byId("programs"), `program ${program.name}`, `${program.version}${program.commit ? `, ${program.commit}` : ""}`);
  }
}

// ---- Controls

function addControls() {
  const box = byId("controls");
  const axisChoice = (label, id, axes, chosen, act) => {
    const select = selection(box, label, axes.map(axis => ({ value: axis.id, text: axis.text })), chosen, value => {
      act(value);
      drawView();
    });
    select.id = id;
    return select;
  };
  axisChoice("time", "time-axis", timeAxes, view.time.id, id => { view.time = timeAxes.find(axis => axis.id === id); });
  const quality = axisChoice("quality", "quality-axis", qualityAxes, view.quality.id, id => {
    view.quality = qualityAxes.find(axis => axis.id === id);
  });
  const places = [{ id: "", text: "whole picture" }, ...maskNames.map(name => ({ id: name, text: name }))];
  axisChoice("measured in", "mask", places, "", mask => {
    view.mask = mask;
    for (const option of quality.options) {
      option.disabled = !isMeasured(qualityAxes.find(axis => axis.id === option.value), mask);
    }
    if (!isMeasured(view.quality, mask)) view.quality = qualityAxes.find(axis => isMeasured(axis, mask)) || view.quality;
    quality.value = view.quality.id;
  });
  addLegend(byId("legend"));
}

/// A button per technique, and one per program where there are several: pressed ones are drawn.
function addLegend(box) {
  const toggle = (set, value, draw) => {
    const button = element(box, "button", { type: "button", class: "legend", "aria-pressed": true, "data-value": value });
    draw(button);
    button.append(value);
    button.addEventListener("click", () => {
      set[set.has(value) ? "delete" : "add"](value);
      button.setAttribute("aria-pressed", set.has(value));
      drawView();
    });
  };
  const symbol = (button, path, isHollow, color) => {
    const svg = d3.select(button).append("svg").attr("width", 14).attr("height", 14).attr("viewBox", "-7 -7 14 14")
      .attr("aria-hidden", true);
    svg.append("path").attr("class", isHollow ? "dot hollow" : "dot").style("color", color).attr("d", path);
  };
  for (const technique of techniques) {
    toggle(view.techniques, technique, button => symbol(button, symbolOf(technique, 70), false, colorOf(technique)));
  }
  if (programs.length < 2) return;
  programs.forEach((program, i) => {
    toggle(view.programs, program, button => symbol(button, d3.symbol().size(70)(), i > 0, "var(--ink)"));
  });
}

// ---- The shot

function drawShotFacts() {
  const shot = shotOf(), box = byId("shot-facts");
  box.replaceChildren();
  fact(box, "size", `${shot.width} × ${shot.height} px`);
  if (numberOf(shot.triangles) !== null) fact(box, "triangles", shot.triangles.toLocaleString("en"));
  fact(box, "file", shot.file || kNone);
  fact(box, "scene", shot.sceneHash || kNone);
  const reference = shot.reference || {};
  fact(box, "reference", reference.samples
    ? `${reference.kind}, ${reference.samples} lens samples` : reference.kind || kNone);
  for (const [name, share] of Object.entries(shot.masks || {})) fact(box, name, percent(numberOf(share)));
}

const viewer = makePictureViewer(byId("viewer"), key => select(key));
function showShotInViewer() {
  const shot = shotOf(), reference = shot.reference || {}, maskPictures = shot.maskPictures || {};
  viewer.show({ reference: { name: "reference", uri: reference.picture },
    pictures: shot.results.map(result => ({ id: result.key, name: nameOf(result), uri: result.picture,
      map: result.flipMap })),
    masks: Object.entries(maskPictures).filter(([, uri]) => uri).map(([name, uri]) => ({ name, uri })) }, selectedKey);
}

/// Bars of the selected variant's passes.
function drawPasses() {
  const result = selectedResult(), box = byId("passes"), passes = (result && result.passes) || [];
  box.replaceChildren();
  byId("passes-title").textContent = result ? `Device time of each pass: ${nameOf(result)}` : "Device time of each pass";
  if (!passes.length) {
    element(box, "p", { class: "quiet" }, "Not measured for this variant.");
    return;
  }
  const sum = d3.sum(passes, pass => pass.ms), most = d3.max(passes, pass => pass.ms) || 1;
  const table = element(box, "table", { class: "bars" }), body = element(table, "tbody");
  const prefix = result.technique + ".";
  for (const { name, ms } of passes) {
    const line = element(body, "tr");
    element(line, "th", { scope: "row", title: name }, name.startsWith(prefix) ? name.slice(prefix.length) : name);
    const bar = element(element(line, "td", { class: "bar" }), "div");
    bar.style.width = 100 * ms / most + "%";
    bar.style.background = colorOf(result.technique);
    element(line, "td", {}, `${brief(ms)} ms`);
    element(line, "td", { class: "quiet" }, percent(ms / (sum || 1)));
  }
  element(box, "p", { class: "quiet" }, `${passes.length} passes, together ${brief(sum)} ms`);
}

// ---- Tables

const spreadText = spread => spread && spread.min < spread.max ? `${brief(spread.min)} … ${brief(spread.max)}` : null;
/// A column whose cells hold a median, and below it the least and the largest.
const spreadColumn = (group, name, title, of) => ({ group, name, title, more: result => spreadText(of(result)),
  value: result => { const spread = of(result); return spread ? spread.median : null; },
  text: result => { const spread = of(result); return brief(spread ? spread.median : null); } });
const plainColumn = (group, name, title, value, show) => ({ group, name, title, value,
  text: result => show(value(result)) });
const countText = value => value === null ? kNone : String(value);
const timeColumn = axis => spreadColumn(axis.unit === "ms" ? "times" : "ratios", axis.short,
  `${axis.text}: median, least … largest`, result => axis.of(result, shotOf()));
const qualityColumn = (group, axis, mask) => plainColumn(group, mask ? `${mask} ${axis.text}` : axis.text,
  mask ? `within ${mask}` : "of the whole picture", result => qualityOf(result, axis, mask),
  value => fixed(value, axis.digits));
const memoryOf = name => result => result.memory ? numberOf(result.memory[name]) : null;

const figureColumns = [
  { name: "variant", isText: true, value: nameOf, text: result => result.technique, more: changedText },
  ...(programs.length > 1 ? [{ name: "program", isText: true, value: r => r.program, text: r => r.program }] : []),
  ...timeAxes.filter(axis => axis.unit === "×").map(timeColumn),
  ...timeAxes.filter(axis => axis.unit === "ms").map(timeColumn),
  ...qualityAxes.map(axis => qualityColumn("quality", axis, "")),
  plainColumn("quality", "not finite", "pixels that are not finite",
    result => result.quality ? numberOf(result.quality.nonFinitePixels) : null, countText),
  ...maskNames.flatMap(mask => qualityAxes.filter(axis => isMeasured(axis, mask))
    .map(axis => qualityColumn("masks", axis, mask))),
  plainColumn("memory", "graph memory", "of the render graph's own resources", memoryOf("graphBytes"), bytes),
  plainColumn("memory", "process memory", "peak of the whole process", memoryOf("processBytes"), bytes),
];
const figureTable = sortableTable(byId("figures"), "All figures of the shot", result => select(result.key));
const groupsShown = new Set(["ratios", "times", "quality"]);
const drawFigureColumns = () => figureTable.setColumns(figureColumns.filter(c => !c.group || groupsShown.has(c.group)));
for (const group of ["ratios", "times", "quality", "masks", "memory"]) {
  const attributes = { type: "button", "aria-pressed": groupsShown.has(group) };
  const button = element(byId("figure-groups"), "button", attributes, group);
  button.addEventListener("click", () => {
    groupsShown[groupsShown.has(group) ? "delete" : "add"](group);
    button.setAttribute("aria-pressed", groupsShown.has(group));
    drawFigureColumns();
  });
}

let matrixFigure = matrixFigures.find(figure => figure.id === "accumulationAtSsim") || matrixFigures[0];
const matrix = sortableTable(byId("matrix"), "One figure of every variant on every shot", row => select(row.key));
function drawMatrix() {
  const { columns, rows } = matrixColumns(matrixFigure, view);
  matrix.setColumns(columns);
  matrix.setRows(rows);
  matrix.mark(selectedKey);
}
const figureChoice = selection(byId("matrix-controls"), "figure",
  matrixFigures.map(figure => ({ value: figure.id, text: figure.text })), matrixFigure.id, id => {
    matrixFigure = matrixFigures.find(figure => figure.id === id);
    drawMatrix();
  });
figureChoice.id = "matrix-figure";

// ---- Choices

function drawShotChart() {
  drawChart(byId("chart"), shotOf(), view, selectedKey, byId("chart").clientWidth, select);
}
function drawView() {
  drawCards(byId("cards"), view, shotIndex, chooseShot);
  drawShotChart();
  drawMatrix();
  figureTable.setRows(shotOf().results.filter(r => view.techniques.has(r.technique) && view.programs.has(r.program)));
  figureTable.mark(selectedKey);
}

/// Chooses a variant of the shot.
function select(key) {
  if (!shotOf().results.some(result => result.key === key)) return;
  const hadFocus = document.activeElement && document.activeElement.closest("#chart");
  selectedKey = key;
  drawShotChart();
  if (hadFocus) byId("chart").querySelector("[aria-pressed=true]").focus();
  figureTable.mark(key);
  matrix.mark(key);
  drawPasses();
  viewer.load(key);
}

/// Chooses a shot, and keeps the variant where the shot has it.
function chooseShot(index) {
  shotIndex = Number(index);
  const { results } = shotOf();
  if (!selectedResult()) {
    // The best of the Pareto front; where there is none, the first that has a picture.
    const front = frontOf(pointsOf(shotOf(), view), view.quality.better).filter(point => point.result.picture);
    const first = front.length ? front[front.length - 1].result : results.find(result => result.picture) || results[0];
    selectedKey = first ? first.key : null;
  }
  byId("shot").value = shotIndex;
  for (const card of byId("cards").children) card.setAttribute("aria-pressed", Number(card.dataset.shot) === shotIndex);
  drawShotFacts();
  drawShotChart();
  drawPasses();
  figureTable.setRows(results.filter(r => view.techniques.has(r.technique) && view.programs.has(r.program)));
  figureTable.mark(selectedKey);
  showShotInViewer();
}

drawHead();
addControls();
const shotChoice = selection(byId("shot-choice"), "shot", shots.map((shot, i) => ({ value: i, text: shotName(shot) })), 0,
  chooseShot);
shotChoice.id = "shot";
drawFigureColumns();
chooseShot(0);
drawView();
drawToWidth(byId("chart"), drawShotChart);
