// Pareto charts: quality over time with a point per variant, the curve of accumulation and the Pareto front; small ones
// for the overview.

/// Scales that hold everything; better is up. Infinite quality goes to the upper edge.
function chartScales(points, curve, view, inner) {
  const times = [...points.flatMap(({ time }) => [time.min, time.max]), ...curve.map(step => step.time)]
    .filter(time => time > 0 && Number.isFinite(time));
  const x = d3.scaleLog([d3.min(times) * 0.85, d3.max(times) * 1.2], inner.x);
  const qualities = [...points, ...curve].map(p => p.quality).filter(Number.isFinite);
  let [least, most] = qualities.length ? d3.extent(qualities) : [0, 1];
  const room = 0.08 * (most - least || Math.abs(most) || 1);
  [least, most] = [least - room, most + room];
  if (view.quality.id !== "psnr") least = Math.max(0, least);
  if (view.quality.id === "ssim") most = Math.min(1, most);
  const linear = d3.scaleLinear(view.quality.better > 0 ? [least, most] : [most, least], inner.y);
  const y = quality => Number.isFinite(quality) ? linear(quality) : inner.y[1];
  return { x, y, linear };
}

/// Ticks of a logarithmic axis that have room for their text: 1, 2, 5 and their powers of ten, or these powers alone.
function timeTicks(x) {
  const [begin, end] = x.domain(), [left, right] = x.range(), ticks = [];
  const decade = (right - left) / Math.log10(end / begin);
  for (let power = Math.floor(Math.log10(begin)); 10 ** power <= end; ++power) {
    for (const factor of decade > 110 ? [1, 2, 5] : [1]) ticks.push(factor * 10 ** power);
  }
  const inside = ticks.filter(tick => tick >= begin && tick <= end);
  return inside.length > 1 ? inside : x.ticks(4);
}
const tickText = value => String(Number(value.toPrecision(6)));

function drawAxes(svg, { x, linear }, view, inner, height) {
  const [left, right] = inner.x, [bottom, top] = inner.y, ticks = timeTicks(x);
  const axis = (kind, where, what) => svg.append("g").attr("class", kind).attr("transform", where).call(what);
  axis("grid", `translate(0,${bottom})`, d3.axisBottom(x).tickValues(ticks).tickSize(top - bottom).tickFormat(""));
  axis("grid", `translate(${left},0)`, d3.axisLeft(linear).ticks(6).tickSize(left - right).tickFormat(""));
  axis("axis", `translate(0,${bottom})`, d3.axisBottom(x).tickValues(ticks).tickFormat(tickText).tickSizeOuter(0));
  axis("axis", `translate(${left},0)`, d3.axisLeft(linear).ticks(6).tickSizeOuter(0));
  svg.append("text").attr("class", "time-title").attr("x", right).attr("y", height - 6).attr("text-anchor", "end")
    .text(view.time.text + " →");
  svg.append("text").attr("class", "quality-title").attr("x", 4).attr("y", 12)
    .text(`↑ ${view.quality.text}${view.mask ? `, ${view.mask}` : ""}` +
      (view.quality.better < 0 ? " (lower is better, so it is up)" : ""));
}

/// The line of accumulation; for ratios to accumulation itself, the upright line at 1.
function drawAccumulation(svg, curve, { x, y }, inner, isToAccumulation) {
  if (isToAccumulation) {
    const [begin, end] = x.domain();
    if (begin > 1 || end < 1) return;
    svg.append("path").attr("class", "accumulation").attr("d", `M${x(1)},${inner.y[0]}V${inner.y[1]}`);
    svg.append("text").attr("class", "accumulation-text").attr("x", x(1) + 5).attr("y", inner.y[0] - 6)
      .text("accumulation");
    return;
  }
  svg.append("path").attr("class", "accumulation")
    .attr("d", d3.line().x(step => x(step.time)).y(step => y(step.quality))(curve));
}

const curveStepText = (step, view) => ["accumulation, " + step.samples + " views",
  [`${view.time.text}: ${brief(step.time)} (views × time of one)`,
    `${view.quality.text}: ${fixed(step.quality, view.quality.digits)}`]];

function pointText({ result, time, quality }, view) {
  const range = time.min < time.max ? ` (${brief(time.min)} … ${brief(time.max)})` : "";
  const lines = [`${view.time.text}: ${brief(time.median)}${range}`,
    `${view.quality.text}${view.mask ? `, ${view.mask}` : ""}: ${fixed(quality, view.quality.digits)}`];
  const ahead = [["PSNR", "accumulationAtPsnr"], ["SSIM", "accumulationAtSsim"]]
    .map(([name, ratio]) => [name, numberOf(statedRatio(result, ratio))]).filter(([, ratio]) => ratio !== null);
  for (const [name, ratio] of ahead) lines.push(`${brief(ratio)} × accumulation at equal ${name}`);
  return [nameOf(result), lines];
}

/// One stop of the Tab key for the whole chart; arrows go from one point to the next in order of time.
function addArrowKeys(nodes, chosen) {
  nodes.forEach((node, i) => {
    node.setAttribute("tabindex", i === Math.max(0, chosen) ? "0" : "-1");
    node.addEventListener("keydown", event => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      const next = step && nodes[i + step];
      if (!next) return;
      event.preventDefault();
      node.setAttribute("tabindex", "-1");
      next.setAttribute("tabindex", "0");
      next.focus();
    });
  });
}

function drawPoints(svg, points, scales, view, selected, select) {
  const { x, y } = scales, nodes = [];
  for (const point of points) {
    const { result, time, quality } = point, at = [x(time.median), y(quality)];
    const group = svg.append("g").attr("class", "point").attr("data-key", result.key).attr("role", "button")
      .attr("aria-pressed", result.key === selected).style("color", colorOf(result.technique));
    const [title, lines] = pointText(point, view);
    group.attr("aria-label", `${title}: ${lines.join("; ")}`);
    group.append("path").attr("class", "whisker").attr("d", `M${x(time.min)},${at[1]}H${x(time.max)}`);
    group.append("circle").attr("class", "halo").attr("r", 11).attr("cx", at[0]).attr("cy", at[1]);
    group.append("path").attr("class", result.program === programs[0] ? "dot" : "dot hollow")
      .attr("transform", `translate(${at})`).attr("d", symbolOf(result.technique, 80));
    const node = group.node();
    explain(node, () => [title, lines]);
    node.addEventListener("click", () => select(result.key));
    node.addEventListener("keydown", event => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); select(result.key); }
    });
    nodes.push(node);
  }
  addArrowKeys(nodes, points.findIndex(point => point.result.key === selected));
}

function drawCurveSteps(svg, curve, { x, y }, view) {
  let last = -Infinity;
  for (const step of curve) {
    const group = svg.append("g").attr("class", "step")
      .attr("transform", `translate(${x(step.time)},${y(step.quality)})`);
    group.append("circle").attr("r", 9).attr("fill", "transparent");
    group.append("circle").attr("r", 3);
    if (x(step.time) - last > 22) {
      group.append("text").attr("y", 17).attr("text-anchor", "middle").text(step.samples);
      last = x(step.time);
    }
    explain(group.node(), () => curveStepText(step, view));
  }
}

/// Draws the chart of a shot into the box, `width` px wide. `select(key)` is called for a point that is chosen.
function drawChart(box, shot, view, selected, width, select) {
  const height = Math.round(Math.max(300, Math.min(460, 0.66 * width)));
  const inner = { x: [52, width - 14], y: [height - 40, 26] };
  box.replaceChildren();
  hideTip();
  const points = pointsOf(shot, view), curve = accumulationOf(shot, view);
  if (!points.length) {
    element(box, "p", { class: "quiet" }, "No variant has both figures here.");
    return;
  }
  const scales = chartScales(points, curve, view, inner);
  const svg = d3.select(box).append("svg").attr("width", width).attr("height", height).attr("role", "group")
    .attr("aria-label", `${view.quality.text} over ${view.time.text}; arrow keys go from point to point`);
  drawAxes(svg, scales, view, inner, height);
  drawAccumulation(svg, curve, scales, inner, view.time.isToAccumulation);
  drawFront(svg, points, scales, view, inner.x[1]);
  if (!view.time.isToAccumulation) drawCurveSteps(svg, curve, scales, view);
  drawPoints(svg, points, scales, view, selected, select);
}

function drawFront(svg, points, { x, y }, view, right) {
  const front = frontOf(points, view.quality.better);
  const line = d3.line().x(p => x(p.time.median)).y(p => y(p.quality)).curve(d3.curveStepAfter);
  svg.append("path").attr("class", "front").attr("d", `${line(front)}H${right}`);
}

/// The same without text, for the overview.
function drawSmallChart(box, shot, view, width) {
  const height = Math.round(0.62 * width), inner = { x: [6, width - 6], y: [height - 8, 8] };
  box.replaceChildren();
  const points = pointsOf(shot, view), curve = accumulationOf(shot, view);
  const svg = d3.select(box).append("svg").attr("width", width).attr("height", height).attr("aria-hidden", true);
  if (!points.length) return;
  const scales = chartScales(points, curve, view, inner);
  drawAccumulation(svg, view.time.isToAccumulation ? [] : curve, scales, inner, view.time.isToAccumulation);
  svg.selectAll(".accumulation-text").remove();
  drawFront(svg, points, scales, view, inner.x[1]);
  for (const { result, time, quality } of points) {
    svg.append("path").attr("class", result.program === programs[0] ? "dot" : "dot hollow")
      .style("color", colorOf(result.technique)).attr("d", symbolOf(result.technique, 34))
      .attr("transform", `translate(${scales.x(time.median)},${scales.y(quality)})`);
  }
}
