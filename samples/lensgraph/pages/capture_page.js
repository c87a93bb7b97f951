// Draws the capture that stands in the page's element #capture, with d3 (axes, scales, zoom) and dagre (graph layout).
"use strict";
const capture = JSON.parse(document.getElementById("capture").textContent);
const graph = capture.graph, passes = graph.passes, resources = graph.resources;
passes.forEach((pass, step) => { pass.step = step; });
resources.forEach((resource, index) => { resource.index = index; });
const kWidth = 1254;  // px of every drawing's own coordinates: the page's column at full width
const kEnd = passes.length;  // the step that stands for "after the last pass"
const kKindColors = { raster: "#4c78a8", compute: "#e8862e", transfer: "#54a24b", host: "#9c6ba5" };
const colorOf = resource => d3.schemeTableau10[resource.index % 10];

// ---- Words

const bytes = n => {
  if (n < 1024) return n + " B";
  const units = ["KiB", "MiB", "GiB", "TiB"], power = Math.min(4, Math.floor(Math.log2(n) / 10));
  const value = n / 1024 ** power;
  return value.toFixed(value < 10 ? 2 : 1) + " " + units[power - 1];
};
const ms = value => value === null ? "–" : value.toFixed(value < 1 ? 3 : value < 100 ? 2 : 1) + " ms";
const spread = time => time === null ? "not measured"
  : graph.frames > 1 ? `${ms(time.median)} (${ms(time.min)} – ${ms(time.max)})` : ms(time.median);
const median = time => time === null ? 0 : time.median;
const barriers = pass => `${pass.imageBarriers} image, ${pass.bufferBarriers} buffer`;
const stepName = step => step === kEnd ? "after the frame" : `${step}: ${passes[step].name}`;
const shapeOf = resource => resource.kind === "image"
  ? `${resource.extent[0]} × ${resource.extent[1]} px` + (resource.layers > 1 ? `, ${resource.layers} layers` : "") +
    (resource.mips > 1 ? `, ${resource.mips} mips` : "") + `, format ${resource.format}` : "buffer";
const cut = (text, length) => text.length > length ? text.slice(0, length - 1) + "…" : text;
/// Names without the technique's, which the page's title says.
const prefix = capture.technique.name + ".";
const brief = name => name.startsWith(prefix) ? name.slice(prefix.length) : name;
/// A name in lines of some 18 characters, broken after dots, spaces and underscores.
function folded(name) {
  const lines = [""];
  for (const part of brief(name).match(/[^._ ]*[._ ]?/g)) {
    if (lines[lines.length - 1].length + part.length > 18 && lines[lines.length - 1]) lines.push("");
    lines[lines.length - 1] += part;
  }
  return lines.map(line => cut(line, 24));
}

const aboutPass = pass => [pass.name, [
  `step ${pass.step}, ${pass.kind}, queue ${pass.queue}`,
  `device ${spread(pass.gpuMs)}`, `recording ${spread(pass.recordMs)}`,
  `reads ${bytes(pass.bytesRead)}, writes ${bytes(pass.bytesWritten)}`,
  `barriers ${barriers(pass)}, batches ${pass.barrierBatches}`,
  ...(pass.resolution[0] ? [`${pass.resolution[0]} × ${pass.resolution[1]} px`] : []),
  ...pass.uses.map(use => `${use.reads && use.writes ? "modifies" : use.writes ? "writes" : "reads"} ` +
                          `${resources[use.resource].name} (${use.usage})`)]];
const aboutResource = resource => [resource.name, [
  `${shapeOf(resource)}, ${resource.origin}`, `content ${bytes(resource.contentBytes)}`,
  ...(resource.heap === null ? ["not placed by the graph"] : [
    `heap ${resource.heap}, offset ${bytes(resource.offset)}, size ${bytes(resource.size)}`]),
  ...(resource.firstStep === null ? ["not used"] : [
    `from ${stepName(resource.firstStep)}`, `to ${stepName(resource.lastStep)}`])]];

// ---- Hovering: a box of details, and the same pass marked in every drawing

const tip = d3.select("#tip");
function showTip([title, lines]) {
  tip.html("").style("visibility", "visible");
  tip.append("b").text(title);
  tip.append("span").text(lines.join("\n"));
  moveTip();
}
function moveTip() {
  const box = tip.node().getBoundingClientRect(), event = d3.event;
  tip.style("left", Math.max(4, Math.min(event.clientX + 14, innerWidth - box.width - 8)) + "px")
    .style("top", Math.max(4, event.clientY + 16 + box.height > innerHeight ? event.clientY - box.height - 12
                                                                             : event.clientY + 16) + "px");
}
const hideTip = () => tip.style("visibility", "hidden");
function hoverPasses(selection) {
  return selection.attr("data-step", pass => pass.step)
    .on("mouseenter", pass => { showTip(aboutPass(pass)); mark(pass.step, true); })
    .on("mousemove", moveTip)
    .on("mouseleave", pass => { hideTip(); mark(pass.step, false); });
}
function hoverResources(selection) {
  return selection.on("mouseenter", resource => showTip(aboutResource(resource)))
    .on("mousemove", moveTip).on("mouseleave", hideTip);
}
function mark(step, on) {
  d3.selectAll(`[data-step="${step}"]`).classed("mark", on);
  d3.selectAll(".edge").classed("on", edge => on && edge.steps && edge.steps.includes(step));
}

// ---- Head

function drawHead() {
  const shot = capture.shot.replace(/^.*\//, "");
  document.title = `${capture.technique.name} – ${shot} – capture`;
  d3.select("#title").text(`${capture.technique.name} on ${shot}`);
  const fact = (where, what, value) => {
    const item = d3.select(where).append("span");
    item.append("span").text(what + " ");
    item.append("b").text(value);
  };
  fact("#facts", "device", `${capture.device.name} (${capture.device.type})`);
  fact("#facts", "driver", capture.device.driver);
  fact("#facts", "picture", `${capture.resolution[0]} × ${capture.resolution[1]} px`);
  fact("#facts", "program", `lensgraph ${capture.program.version}` +
    (capture.program.commit ? `, ${capture.program.commit}` : ""));
  fact("#facts", "input", capture.inputHash);
  for (const [name, value] of Object.entries(capture.technique.parameters)) fact("#parameters", name, value);
  fact("#parameters", "aperture radius", `${(1000 * capture.lens.apertureRadius).toFixed(2)} mm`);
  fact("#parameters", "focus", typeof capture.lens.focusDistance === "number"
    ? `${capture.lens.focusDistance} m` : capture.lens.focusDistance);
}

function drawTiles() {
  const tile = (what, value, more) => {
    const box = d3.select("#tiles").append("div").attr("class", "tile");
    box.append("div").attr("class", "what").text(what);
    box.append("div").attr("class", "value").text(value);
    box.append("div").attr("class", "more quiet").text(more);
  };
  const range = time => time === null ? "not measured"
    : graph.frames > 1 ? `${ms(time.min)} – ${ms(time.max)}` : "one frame";
  const sum = graph.passSumMs, memory = graph.memory;
  tile("device time, median", ms(graph.frameGpuMs && graph.frameGpuMs.median), range(graph.frameGpuMs));
  tile("sum of the passes", ms(sum && sum.median), graph.frameGpuMs === null || sum === null ? "" :
    `${(100 * sum.median / graph.frameGpuMs.median).toFixed(1)} % of it`);
  if (capture.uninterrupted) {
    tile("uninterrupted", ms(capture.uninterrupted.median),
         `the same ${capture.executions > 1 ? "picture" : "frame"} in one piece`);
  }
  tile("wall time, median", ms(graph.frameWallMs && graph.frameWallMs.median), range(graph.frameWallMs));
  if (capture.executions > 1) {
    tile("whole picture", ms(capture.gpuMs && capture.gpuMs.median),
         `${capture.executions} executions; this page is of the last`);
  }
  tile("memory", bytes(memory.peakBytes), memory.peakBytes === 0 ? "none of its own"
    : `${bytes(memory.unaliasedBytes)} unshared; bound ${bytes(memory.lowerBound)}`);
  tile("passes", String(passes.length), `${graph.barrierBatches} barrier batches, ${graph.culled.length} culled`);
}

// ---- Graph

const textWidth = text => 7 * text.length;

/// Nodes of what comes from outside the frame, or is seen after it, beside the passes.
function graphParts() {
  const nodes = passes.map(pass => ({
    id: "p" + pass.step, pass,
    lines: [...folded(pass.name), ...(pass.gpuMs === null ? [] : [ms(pass.gpuMs.median)])] }));
  const edges = new Map();
  const addEdge = (from, to, resource, steps) => {
    const key = from + ">" + to;
    if (!edges.has(key)) edges.set(key, { from, to, steps, resources: [] });
    if (!edges.get(key).resources.includes(resource)) edges.get(key).resources.push(resource);
  };
  for (const edge of graph.edges) {
    addEdge("p" + edge.from, "p" + edge.to, resources[edge.resource], [edge.from, edge.to]);
  }
  for (const resource of resources) {
    if (resource.firstStep === null) continue;
    const users = passes.filter(pass => pass.uses.some(use => use.resource === resource.index));
    const reads = (pass) => pass.uses.some(use => use.resource === resource.index && use.reads);
    const writers = users.filter(pass => pass.uses.some(use => use.resource === resource.index && use.writes));
    const fed = pass => graph.edges.some(edge => edge.to === pass.step && edge.resource === resource.index);
    const first = users.filter(pass => reads(pass) && !fed(pass));
    const node = (suffix, lines) => nodes.push({ id: "r" + resource.index + suffix, resource, lines });
    if (resource.origin !== "created" && first.length) {
      node("in", folded(resource.name));
      for (const pass of first) addEdge("r" + resource.index + "in", "p" + pass.step, resource, [pass.step]);
    }
    if (resource.lastStep === kEnd && writers.length) {
      node("out", folded(resource.name));
      const last = writers[writers.length - 1];
      addEdge("p" + last.step, "r" + resource.index + "out", resource, [last.step]);
    }
  }
  return { nodes, edges: [...edges.values()] };
}

function drawGraph() {
  const { nodes, edges } = graphParts();
  const layout = new dagre.graphlib.Graph();
  layout.setGraph({ rankdir: "LR", nodesep: 14, ranksep: 26, marginx: 16, marginy: 16 });
  for (const node of nodes) {
    layout.setNode(node.id, { width: 22 + d3.max(node.lines, textWidth), height: 12 + 16 * node.lines.length, node });
  }
  for (const edge of edges) layout.setEdge(edge.from, edge.to, { edge });
  dagre.layout(layout);
  const size = layout.graph();
  const height = Math.max(110, Math.min(620, size.height, size.height * kWidth / size.width + 60));
  const svg = d3.select("#graph").append("svg").attr("viewBox", [0, 0, kWidth, height]);
  svg.append("defs").append("marker").attr("id", "arrow").attr("viewBox", "0 0 8 8").attr("refX", 7).attr("refY", 4)
    .attr("markerUnits", "userSpaceOnUse").attr("markerWidth", 9).attr("markerHeight", 9).attr("orient", "auto")
    .append("path").attr("d", "M0,0L8,4L0,8z").style("fill", "var(--edge)");
  const all = svg.append("g");
  const zoom = d3.zoom().scaleExtent([0.05, 4]).on("zoom", () => all.attr("transform", d3.event.transform));
  const scale = Math.min(1, kWidth / size.width, height / size.height);
  svg.call(zoom).call(zoom.transform, d3.zoomIdentity
    .translate((kWidth - scale * size.width) / 2, (height - scale * size.height) / 2).scale(scale));
  const line = d3.line().x(point => point.x).y(point => point.y).curve(d3.curveBasis);
  const drawn = layout.edges().map(name => ({ ...layout.edge(name).edge, points: layout.edge(name).points }));
  all.selectAll(".edge").data(drawn)
    .enter().append("path").attr("class", "edge").attr("d", edge => line(edge.points)).attr("marker-end", "url(#arrow)")
    .on("mouseenter", function (edge) {
      d3.select(this).classed("on", true);
      const tell = r => `${r.name}: ${shapeOf(r)}, ${bytes(r.contentBytes)}`;
      showTip(["from one pass to the next", edge.resources.map(tell)]);
    })
    .on("mousemove", moveTip)
    .on("mouseleave", function () { d3.select(this).classed("on", false); hideTip(); });
  const boxes = all.selectAll(".node").data(nodes).enter().append("g")
    .attr("transform", node => `translate(${layout.node(node.id).x},${layout.node(node.id).y})`);
  boxes.append("rect").each(function (node) {
    const { width, height: h } = layout.node(node.id);
    d3.select(this).attr("x", -width / 2).attr("y", -h / 2).attr("width", width).attr("height", h)
      .attr("rx", node.pass ? 5 : 14)
      .style("fill", node.pass
        ? `color-mix(in srgb, ${kKindColors[node.pass.kind] || "#888"} 22%, var(--paper))` : "var(--paper)")
      .attr("stroke", node.pass ? kKindColors[node.pass.kind] || "#888" : "#8793a1")
      .attr("stroke-dasharray", node.pass ? null : "4 3");
  });
  boxes.each(function (node) {
    const names = node.pass ? node.lines.length - (node.pass.gpuMs === null ? 0 : 1) : 0;
    node.lines.forEach((text, i) => d3.select(this).append("text").attr("text-anchor", "middle")
      .attr("y", 16 * (i - node.lines.length / 2) + 12)
      .style("font-weight", i < names ? 600 : 400).text(text));
  });
  hoverPasses(boxes.filter(node => node.pass).datum(node => node.pass));
  hoverResources(boxes.filter(node => node.resource).datum(node => node.resource));
  for (const kind of new Set(passes.map(pass => pass.kind))) {
    const item = d3.select("#kinds").append("span");
    item.append("i").style("background", kKindColors[kind] || "#888");
    item.append("span").text(kind);
  }
  const item = d3.select("#kinds").append("span");
  item.append("i").style("border", "1px dashed var(--edge)");
  item.append("span").text("from outside the frame, or seen after it");
}

// ---- Charts

/// A drawing of that height with room for labels on the left; gives its inside.
function chart(where, height, left) {
  const svg = d3.select(where).append("svg").attr("viewBox", [0, 0, kWidth, height]);
  return svg.append("g").attr("transform", `translate(${left},0)`);
}
const labelRoom = names => Math.min(330, 30 + d3.max(names, textWidth));

function drawTimes(sorted) {
  d3.select("#times").selectAll("*").remove();
  const rows = sorted ? [...passes].sort((a, b) => median(b.gpuMs) - median(a.gpuMs)) : passes;
  const label = pass => `${pass.step}  ${cut(brief(pass.name), 40)}`;
  const left = labelRoom(rows.map(label)), right = 190, height = 22 * rows.length + 46;
  const inside = chart("#times", height, left);
  const x = d3.scaleLinear([0, d3.max(passes, pass => pass.gpuMs === null ? 0 : pass.gpuMs.max) || 1],
                           [0, kWidth - left - right]).nice();
  const y = d3.scaleBand(rows.map(pass => pass.step), [8, height - 38]).padding(0.25);
  inside.append("g").attr("class", "grid").attr("transform", `translate(0,${height - 36})`)
    .call(d3.axisBottom(x).ticks(8).tickSize(-(height - 44)).tickFormat(""));
  inside.append("g").attr("class", "axis").attr("transform", `translate(0,${height - 36})`)
    .call(d3.axisBottom(x).ticks(8));
  inside.append("text").attr("x", x.range()[1]).attr("y", height - 6).attr("text-anchor", "end")
    .style("fill", "var(--quiet)").text("device time, ms");
  const row = hoverPasses(inside.selectAll(".row").data(rows).enter().append("g")
    .attr("transform", pass => `translate(0,${y(pass.step)})`));
  row.append("rect").attr("width", pass => x(median(pass.gpuMs))).attr("height", y.bandwidth()).attr("rx", 2)
    .attr("fill", pass => kKindColors[pass.kind] || "#888");
  const middle = y.bandwidth() / 2;
  row.filter(pass => pass.gpuMs !== null && graph.frames > 1)
    .append("path").attr("fill", "none").style("stroke", "var(--ink)")
    .attr("d", ({ gpuMs }) => `M${x(gpuMs.min)},${middle}H${x(gpuMs.max)}` +
      `M${x(gpuMs.min)},${middle - 4}v8M${x(gpuMs.max)},${middle - 4}v8`);
  row.append("text").attr("x", -8).attr("y", middle + 4).attr("text-anchor", "end").text(label);
  row.append("text").attr("x", pass => x(pass.gpuMs === null ? 0 : pass.gpuMs.max) + 8).attr("y", middle + 4)
    .text(pass => pass.gpuMs === null ? "not measured" : `${ms(pass.gpuMs.median)} · ` +
      (100 * pass.gpuMs.median / Math.max(1e-9, d3.sum(passes, p => median(p.gpuMs)))).toFixed(1) + " %");
}

const steps = d3.range(kEnd + 1);
/// Horizontal axis of steps, of which as many are told as there is room for.
function stepAxis(inside, x, bottom) {
  const every = Math.ceil(steps.length / 40);
  const told = steps.filter(step => step === kEnd || (step % every === 0 && step + every / 2 < kEnd));
  inside.append("g").attr("class", "axis").attr("transform", `translate(0,${bottom})`)
    .call(d3.axisBottom(x).tickValues(told)
      .tickFormat(step => step === kEnd ? "after" : step));
  inside.append("text").attr("x", x.range()[1]).attr("y", bottom + 32).attr("text-anchor", "end")
    .style("fill", "var(--quiet)").text("step");
}

function drawLifetimes() {
  const rows = resources.filter(resource => resource.firstStep !== null);
  const label = resource => cut(brief(resource.name), 42);
  const left = labelRoom(rows.map(label)), height = 20 * rows.length + 52, bottom = height - 42;
  const inside = chart("#lifetimes", height, left);
  const x = d3.scaleBand(steps, [0, kWidth - left - 110]);
  const y = d3.scaleBand(rows.map(r => r.index), [8, bottom]).padding(0.22);
  inside.append("g").attr("class", "grid").attr("transform", `translate(0,${bottom})`)
    .call(d3.axisBottom(x).tickSize(-(bottom - 8)).tickFormat(""));
  stepAxis(inside, x, bottom);
  const row = hoverResources(inside.selectAll(".row").data(rows).enter().append("g")
    .attr("transform", r => `translate(0,${y(r.index)})`));
  row.append("rect").attr("x", r => x(r.firstStep) + 1)
    .attr("width", r => x(r.lastStep) + x.bandwidth() - x(r.firstStep) - 2)
    .attr("height", y.bandwidth()).attr("rx", 2).attr("fill", colorOf).attr("opacity", r => r.heap === null ? 0.35 : 1);
  row.append("text").attr("x", -8).attr("y", y.bandwidth() / 2 + 4).attr("text-anchor", "end").text(label);
  row.append("text").attr("x", x.range()[1] + 8).attr("y", y.bandwidth() / 2 + 4).style("fill", "var(--quiet)")
    .text(r => bytes(r.contentBytes));
}

function drawHeap(heap, index) {
  const placed = resources.filter(resource => resource.heap === index);
  const box = d3.select("#memory");
  box.append("p").text(`Heap ${index}: ${bytes(heap.size)}, ${heap.memory} memory, ${placed.length} resources`);
  const height = Math.max(120, Math.min(360, 90 + 26 * placed.length)), left = 84, bottom = height - 42;
  const inside = chart(box.append("figure").node(), height, left);
  const x = d3.scaleBand(steps, [0, kWidth - left - 24]), y = d3.scaleLinear([0, heap.size], [bottom, 12]);
  const unit = heap.size >= 2 ** 20 ? ["MiB", 2 ** 20] : ["KiB", 2 ** 10];
  const inUnits = d3.scaleLinear([0, heap.size / unit[1]], y.range());
  inside.append("g").attr("class", "axis").call(d3.axisLeft(inUnits).ticks(5));
  inside.append("text").attr("x", -left + 10).attr("y", 16).style("fill", "var(--quiet)").text(unit[0]);
  stepAxis(inside, x, bottom);
  const block = hoverResources(inside.selectAll(".block").data(placed).enter().append("g"));
  const width = r => x(r.lastStep) + x.bandwidth() - x(r.firstStep) - 1;
  block.append("rect").attr("x", r => x(r.firstStep)).attr("width", width).attr("y", r => y(r.offset + r.size))
    .attr("height", r => Math.max(1.5, y(r.offset) - y(r.offset + r.size)))
    .attr("fill", colorOf).style("stroke", "var(--paper)");
  block.filter(r => y(r.offset) - y(r.offset + r.size) > 13 && width(r) > 40).append("text")
    .attr("x", r => x(r.firstStep) + 6).attr("y", r => (y(r.offset) + y(r.offset + r.size)) / 2 + 4)
    .style("fill", r => d3.lab(colorOf(r)).l > 68 ? "#1d2733" : "#fff")
    .style("pointer-events", "none").text(r => cut(brief(r.name), Math.floor((width(r) - 8) / 7)));
}

// ---- Table

const kColumns = [
  ["step", pass => pass.step, String],
  ["pass", pass => pass.name, (value) => value],
  ["kind", pass => pass.kind, value => value],
  ["queue", pass => pass.queue, String],
  ["resolution", pass => pass.resolution[0] * pass.resolution[1],
    (_, pass) => pass.resolution[0] ? pass.resolution.join(" × ") : "–"],
  ["device ms", pass => median(pass.gpuMs), (_, pass) => pass.gpuMs === null ? "–" : pass.gpuMs.median.toFixed(3)],
  ["min – max", pass => pass.gpuMs === null ? 0 : pass.gpuMs.max - pass.gpuMs.min,
    (_, pass) => pass.gpuMs === null ? "–" : `${pass.gpuMs.min.toFixed(3)} – ${pass.gpuMs.max.toFixed(3)}`],
  ["record ms", pass => median(pass.recordMs), value => value.toFixed(3)],
  ["read", pass => pass.bytesRead, bytes],
  ["written", pass => pass.bytesWritten, bytes],
  ["GB/s", pass => median(pass.gpuMs) > 0 ? (pass.bytesRead + pass.bytesWritten) / median(pass.gpuMs) * 1e-6 : 0,
    value => value >= 0.005 ? value.toFixed(2) : "–"],
  ["barriers", pass => pass.imageBarriers + pass.bufferBarriers,
    (value, pass) => value === 0 ? "–" : `${pass.imageBarriers} img, ${pass.bufferBarriers} buf`],
  ["batches", pass => pass.barrierBatches, String],
];

function drawTable() {
  const table = d3.select("#passes");
  let sortedBy = 0, up = true;
  const isText = column => column[0] === "pass" || column[0] === "kind";
  const heads = table.append("thead").append("tr").selectAll("th").data(kColumns).enter().append("th")
    .classed("text", isText).text(column => column[0]);
  const body = table.append("tbody");
  const fill = () => {
    const value = kColumns[sortedBy][1];
    const rows = [...passes].sort((a, b) => (up ? 1 : -1) * d3.ascending(value(a), value(b)) || a.step - b.step);
    body.selectAll("tr").remove();
    hoverPasses(body.selectAll("tr").data(rows).enter().append("tr")).selectAll("td")
      .data(pass => kColumns.map(column => [column, pass])).enter().append("td")
      .classed("text", ([column]) => isText(column)).text(([column, pass]) => column[2](column[1](pass), pass));
    heads.classed("sorted", (_, i) => i === sortedBy).classed("up", up);
  };
  heads.on("click", (column, i) => {
    up = sortedBy === i ? !up : isText(column) || i === 0;
    sortedBy = i;
    fill();
  });
  fill();
}

drawHead();
drawTiles();
drawGraph();
const kTimings = {
  isolated: "Isolated: each pass was submitted and waited for by itself, timed by the host; includes the cost of a " +
    "submission (some 10 µs).",
  inline: "Inline: timestamps before and after each pass in the one submission.",
  none: "Device times were not measured.",
};
d3.select("#timing").text(`${graph.frames} frame${graph.frames > 1 ? "s" : ""}; bars are medians, whiskers the fastest ` +
  `and the slowest. ${kTimings[graph.timing] || ""}`);
drawTimes(false);
for (const [id, other, sorted] of [["#by-order", "#by-time", false], ["#by-time", "#by-order", true]]) {
  d3.select(id).on("click", () => {
    d3.select(id).attr("aria-pressed", true);
    d3.select(other).attr("aria-pressed", false);
    drawTimes(sorted);
  });
}
drawLifetimes();
graph.memory.heaps.forEach(drawHeap);
if (!graph.memory.heaps.length) d3.select("#memory").append("p").text("The graph has no memory of its own.");
drawTable();
if (graph.culled.length) {
  d3.select("#culled").attr("hidden", null).select("ul").selectAll("li").data(graph.culled).enter().append("li")
    .text(culled => `${culled.name}: ${culled.reason}`);
}
