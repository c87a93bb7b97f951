// The bench in the page's element #data, made ready for drawing: axes, points, the curve of accumulation, Pareto fronts.
const bench = data, shots = bench.shots, programs = bench.programs.map(program => program.name);

/// What times are compared by: processor time where the processor draws, else the device's.
const kClock = bench.device && bench.device.type === "cpu" ? "cpuMs" : "gpuMs";

const techniques = [...new Set(shots.flatMap(shot => shot.results.map(result => result.technique)))];
const maskNames = [...new Set(shots.flatMap(shot => Object.keys(shot.masks || {})))];
const kSymbols = [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, d3.symbolCross, d3.symbolStar,
                  d3.symbolWye];
const colorOf = technique => `var(--series-${techniques.indexOf(technique) % 8})`;
const symbolOf = (technique, size) =>
  d3.symbol().type(kSymbols[techniques.indexOf(technique) % kSymbols.length]).size(size)();

// Keys of results within their shot, and in words.
for (const shot of shots) {
  shot.results.forEach(result => { result.key = `${result.program} ${result.id}`; });
}
const changedText = result => Object.entries(result.changed || {}).map(([name, value]) => `${name} ${value}`).join(", ");
function nameOf(result) {
  const changed = changedText(result), program = programs.length > 1 ? ` (${result.program})` : "";
  return result.technique + (changed ? `, ${changed}` : "") + program;
}
const shotName = shot => `${shot.name || shot.id}, ${shot.width} × ${shot.height}`;

// ---- Times: {median, min, max}, or null

function spreadOf(times, clock) {
  const spread = times && times[clock];
  return spread && numberOf(spread.median) !== null ? spread : null;
}

/// The ratio of two spreads. Variants take turns in a run, so that sample i of one belongs to sample i of the other; the
/// spread of the ratio is that of these pairs. Where the numbers of samples differ, it is over the other's median.
/// `stated`: the median that the file gives, which counts where it is there.
function ratioOf(spread, unit, stated) {
  const given = numberOf(stated);
  if (!spread || !unit || !(unit.median > 0)) return given === null ? null : { median: given, min: given, max: given };
  const [a, b] = [spread.samples || [], unit.samples || []];
  const isPaired = a.length > 1 && a.length === b.length && b.every(time => time > 0);
  const ratios = isPaired ? a.map((time, i) => time / b[i]) : [spread.min / unit.median, spread.max / unit.median];
  return { median: given === null ? spread.median / unit.median : given, min: Math.min(...ratios),
    max: Math.max(...ratios) };
}

const sameVariantOf = (shot, result, program) =>
  shot.results.find(other => other.program === program && other.id === result.id);
const alone = value => value === null ? null : { median: value, min: value, max: value };
const statedRatio = (result, name) => result.ratios ? result.ratios[name] : null;

/// Time axes: `short` heads columns; `of(result, shot)` is a spread; `accumulation(shot, samples)`
/// is the time of so many views of accumulation, or null.
const viewsOf = (shot, clock, samples) => {
  const view = spreadOf(shot.units && shot.units.accumulationView, clock);
  return view ? samples * view.median : null;
};
function unitAxis(id, text, short) {
  const unitOf = shot => spreadOf(shot.units && shot.units[id], kClock);
  return { id, text, short, unit: "×",
    of: (result, shot) => ratioOf(spreadOf(result, kClock), unitOf(shot), statedRatio(result, id)),
    accumulation: (shot, samples) => {
      const time = viewsOf(shot, kClock, samples), unit = unitOf(shot);
      return time !== null && unit && unit.median > 0 ? time / unit.median : null;
    } };
}
const equalQualityAxis = (id, text, short) => ({ id, text, short, unit: "×", isToAccumulation: true,
  of: result => alone(numberOf(statedRatio(result, id))), accumulation: () => 1 });
const clockAxis = (id, text, short) => ({ id, text, short, unit: "ms", of: result => spreadOf(result, id),
  accumulation: (shot, samples) => viewsOf(shot, id, samples) });
const programAxis = program => ({ id: `program ${program}`, text: `time / ${program}`, short: `× ${program}`, unit: "×",
  of: (result, shot) => {
    const other = sameVariantOf(shot, result, program);
    if (!other || result.program === program) return null;
    return ratioOf(spreadOf(result, kClock), spreadOf(other, kClock), (statedRatio(result, "programs") || {})[program]);
  },
  accumulation: () => null });

const timeAxes = [
  unitAxis("pinhole", "time / pinhole frame", "× pinhole"), unitAxis("copy", "time / full-screen copy", "× copy"),
  equalQualityAxis("accumulationAtPsnr", "time / accumulation at equal PSNR", "×\u00a0accum. at\u00a0PSNR"),
  equalQualityAxis("accumulationAtSsim", "time / accumulation at equal SSIM", "×\u00a0accum. at\u00a0SSIM"),
  ...programs.slice(1).map(programAxis),
  clockAxis("cpuMs", "processor time, ms", "proc. ms"), clockAxis("wallMs", "wall time, ms", "wall ms"),
  clockAxis("gpuMs", "device time, ms", "device ms"),
].filter(axis => shots.some(shot => shot.results.some(result => axis.of(result, shot) !== null)));

// ---- Quality

const qualityAxes = [
  { id: "psnr", text: "PSNR, dB", digits: 2, better: 1 }, { id: "ssim", text: "SSIM", digits: 4, better: 1 },
  { id: "flip", text: "FLIP", digits: 4, better: -1 },
  { id: "relativeRmse", text: "relative RMSE", digits: 4, better: -1 },
  { id: "maxError", text: "largest error", digits: 3, better: -1 },
];
/// Of the whole picture (mask "") or within a mask; null where there is none.
function qualityOf(result, axis, mask) {
  const quality = result.quality || {};
  const part = mask ? (quality.masks || {})[mask] : quality;
  return part ? numberOf(part[axis.id]) : null;
}

/// Whether anything is measured so.
const isMeasured = (axis, mask) => shots.some(shot => shot.results.some(r => qualityOf(r, axis, mask) !== null));

// ---- What charts draw

/// The shot's points that both axes and the filters have, ordered by time.
function pointsOf(shot, view) {
  return shot.results.filter(result => view.techniques.has(result.technique) && view.programs.has(result.program))
    .map(result => ({ result, time: view.time.of(result, shot), quality: qualityOf(result, view.quality, view.mask) }))
    .filter(point => point.time && point.time.median > 0 && point.quality !== null)
    .sort((a, b) => a.time.median - b.time.median);
}

/// The curve of accumulation: its quality is known for the whole picture alone.
function accumulationOf(shot, view) {
  if (view.mask) return [];
  return (shot.accumulation || []).map(step => ({ samples: step.samples, quality: numberOf(step[view.quality.id]),
    time: view.time.accumulation(shot, step.samples) })).filter(step => step.time > 0 && step.quality !== null);
}

/// Of points ordered by time, those better than all faster ones.
function frontOf(points, better) {
  let best = -Infinity;
  return points.filter(({ quality }) => {
    const isBetter = better * quality > best;
    if (isBetter) best = better * quality;
    return isBetter;
  });
}
