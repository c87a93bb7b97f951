// What the picture viewer shows: decoded pictures, and the pictures computed of two of them.

/// Decoded pictures by their data URI, the latest few of them.
const decodedPictures = new Map();
const kPicturesKept = 24;

/// The picture as {width, height, image, pixels}; pixels: 8-bit sRGB RGBA. Null when there is none.
async function decodePicture(uri) {
  if (!uri) return null;
  let entry = decodedPictures.get(uri);
  if (!entry) {
    const image = new Image();
    image.src = uri;
    entry = image.decode().then(() => {
      const canvas = canvasOf(image.naturalWidth, image.naturalHeight);
      const context = canvas.getContext("2d", { willReadFrequently: true });
      context.drawImage(image, 0, 0);
      const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height);
      return { width: canvas.width, height: canvas.height, image: canvas, pixels };
    });
  }
  decodedPictures.delete(uri);
  decodedPictures.set(uri, entry);
  if (decodedPictures.size > kPicturesKept) decodedPictures.delete(decodedPictures.keys().next().value);
  return entry;
}

function canvasOf(width, height) {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

/// A canvas whose pixels `color(i)` gives; i: index of the pixel's first sample. Opaque unless `color` gives four.
function paintedCanvas(width, height, color) {
  const canvas = canvasOf(width, height), context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  for (let i = 0; i < image.data.length; i += 4) {
    const [r, g, b, a = 255] = color(i);
    image.data[i] = r;
    image.data[i + 1] = g;
    image.data[i + 2] = b;
    image.data[i + 3] = a;
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/// |a − b| of every displayed channel, times the gain.
function differenceCanvas(a, b, gain) {
  const at = i => gain * Math.abs(a.pixels[i] - b.pixels[i]);
  return paintedCanvas(a.width, a.height, i => [at(i), at(i + 1), at(i + 2)]);
}

/// The colors of FLIP's maps ("magma", as its authors use), for 0 to 255.
const kMapColors = d3.range(256).map(i => {
  const { r, g, b } = d3.rgb(d3.interpolateMagma(i / 255));
  return [r, g, b];
});
const mapCanvas = map => paintedCanvas(map.width, map.height, i => kMapColors[map.pixels[i]]);

/// The mask in one color, clear elsewhere.
const maskCanvas = (mask, [r, g, b]) =>
  paintedCanvas(mask.width, mask.height, i => mask.pixels[i] > 0 ? [r, g, b, 150] : [0, 0, 0, 0]);
const kMaskColors = [[255, 75, 110], [70, 200, 255], [255, 190, 40], [130, 235, 110], [190, 130, 255], [255, 140, 70]];
