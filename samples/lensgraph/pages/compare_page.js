// The page of a comparison: the figures of every picture as a table, and the pictures in the viewer.

const byId = id => document.getElementById(id);
data.pictures.forEach((picture, i) => { picture.key = String(i); });

document.title = `${data.title} – comparison`;
byId("title").textContent = data.title;
addThemeButton(byId("head"));
fact(byId("facts"), "reference", data.referenceName);
fact(byId("facts"), "size", `${data.width} × ${data.height} px`);
fact(byId("facts"), "exposure", `${data.exposureEv} EV`);
if (data.program) fact(byId("facts"), "program", data.program);

const figureOf = name => picture => numberOf((picture.figures || {})[name]);
const maskFigureOf = (mask, name) => picture => {
  const figures = ((picture.figures || {}).masks || {})[mask];
  return figures ? numberOf(figures[name]) : null;
};
const column = (name, title, value, show) => ({ name, title, value, text: picture => show(value(picture)) });
const digits = places => value => fixed(value, places);
const count = value => value === null ? kNone : String(value);
const maskNames = [...new Set(data.pictures.flatMap(picture => Object.keys((picture.figures || {}).masks || {})))];
const kAllColumns = [
  { name: "picture", isText: true, value: picture => picture.name, text: picture => picture.name },
  column("PSNR, dB", "of the displayed picture; larger is better", figureOf("psnr"), digits(2)),
  column("SSIM", "of the displayed picture; larger is better", figureOf("ssim"), digits(4)),
  column("FLIP", "mean of the map; smaller is better", figureOf("flip"), digits(4)),
  column("relative RMSE", "in linear light; smaller is better", figureOf("relativeRmse"), digits(4)),
  column("largest error", "of a displayed channel, 0 to 1", figureOf("maxError"), digits(3)),
  column("not finite", "pixels that are not finite", figureOf("nonFinitePixels"), count),
  ...maskNames.flatMap(mask => [
    column(`${mask} PSNR`, `dB, within ${mask}`, maskFigureOf(mask, "psnr"), digits(2)),
    column(`${mask} SSIM`, `within ${mask}`, maskFigureOf(mask, "ssim"), digits(4)),
    column(`${mask} pixels`, `pixels in ${mask}`, maskFigureOf(mask, "pixels"), count)]),
];
// Figures that nobody measured have no column.
const columns = kAllColumns.filter((c, i) => i === 0 || data.pictures.some(picture => c.value(picture) !== null));

const table = sortableTable(byId("figures"), "Figures of the pictures", picture => select(picture.key));
const viewer = makePictureViewer(byId("viewer"), key => table.mark(key));
function select(key) {
  table.mark(key);
  viewer.load(key);
}

table.setColumns(columns);
table.setRows(data.pictures);
table.mark("0");
viewer.show({ reference: { name: data.referenceName, uri: data.reference },
  pictures: data.pictures.map(({ key, name, picture, flipMap }) => ({ id: key, name, uri: picture, map: flipMap })),
  masks: data.masks.map(({ name, picture }) => ({ name, uri: picture })) }, "0");
