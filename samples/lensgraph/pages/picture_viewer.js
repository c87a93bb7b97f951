// The picture viewer: a picture beside, over or minus another one, with zoom and pan, on a canvas.
//
// makePictureViewer(box, select) draws into the element and returns {show(set, id)}. A set: {reference: {name, uri},
// pictures: [{id, name, uri, map}], masks: [{name, uri}]}; `map` is the picture's FLIP map. `select(id)` is called when
// the user takes another picture in the viewer itself. Pictures of one set have one size. viewer_controls.js has the
// buttons, keys and the mouse.
const kLargestZoom = 64;
const kGap = 4, kSideBySideFrom = 800;  // px; in a narrower canvas one view is below the other

class PictureViewer extends ViewerControls {
  constructor(box, select) {
    super(box, select);
    this.state = { mode: "divider", zoom: 1, x: 0, y: 0, divider: 0.5, gain: 4, isFitted: true };
    this.shown = {};
    this.masksOn = new Set();
    this.addControls();
    this.addCanvas();
    drawToWidth(this.canvas, () => this.layOut());
    matchMedia("(resolution: 1dppx)").addEventListener("change", () => this.layOut());
  }

  // ---- State

  setMode(mode) {
    if (this.modes.buttons.find(button => button.dataset.value === mode).disabled) return;
    this.state.mode = mode;
    this.modes.press(mode);
    this.layOut();
  }
  setGain(gain) {
    this.state.gain = Math.max(1, Math.min(64, gain));
    this.gainSlider.input.value = Math.log2(this.state.gain);
    this.draw();
  }
  moveDivider(share) {
    this.state.divider = Math.max(0, Math.min(1, share));
    this.dividerSlider.input.value = 100 * this.state.divider;
    this.draw();
  }
  moveBy(x, y) {
    this.state.x += x;
    this.state.y += y;
    this.draw();
  }
  /// The point of the picture at (x, y), px of the canvas, stays where it is.
  zoomBy(factor, x, y) {
    this.zoomTo(this.state.zoom * factor, x, y);
  }
  zoomTo(zoom, x = this.viewSize().width / 2, y = this.viewSize().height / 2) {
    const { state } = this, from = this.fromCenter(x, y), before = state.zoom;
    state.zoom = Math.max(this.fittingZoom() / 2, Math.min(kLargestZoom, zoom));
    state.x += from.x * (1 / before - 1 / state.zoom);
    state.y += from.y * (1 / before - 1 / state.zoom);
    state.isFitted = false;
    this.draw();
  }
  fit() {
    this.state.isFitted = true;
    this.draw();
  }
  isStacked() {
    return this.state.mode === "side" && this.canvas.clientWidth < kSideBySideFrom;
  }
  /// Of each of the two views that lie beside or below each other, else of the only one, px.
  viewSize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.state.mode !== "side") return { width, height };
    return this.isStacked() ? { width, height: (height - kGap) / 2 } : { width: (width - kGap) / 2, height };
  }
  /// From the middle of the view in which (x, y) lies, px.
  fromCenter(x, y) {
    const { width, height } = this.viewSize();
    return { x: (x > width ? x - width - kGap : x) - width / 2, y: (y > height ? y - height - kGap : y) - height / 2 };
  }
  fittingZoom() {
    const { picture, other } = this.shown, size = picture || other, view = this.viewSize();
    return size ? Math.min(view.width / size.width, view.height / size.height) : 1;
  }

  // ---- Pictures

  show(set, id) {
    this.set = set;
    const options = (select, values) => {
      select.replaceChildren();
      for (const { id: value, name, uri } of values) {
        element(select, "option", { value }, uri ? name : `${name} (no picture)`);
      }
    };
    options(this.pictureChoice, set.pictures);
    options(this.otherChoice, [{ id: "", ...set.reference }, ...set.pictures]);
    this.otherChoice.value = "";
    this.maskBox.replaceChildren();
    this.maskBox.hidden = !set.masks.length;
    set.masks.forEach(({ name }, i) => {
      const label = element(this.maskBox, "label"), input = element(label, "input", { type: "checkbox", value: name });
      input.checked = this.masksOn.has(name);
      element(label, "i", { class: "swatch" }).style.background = `rgb(${kMaskColors[i % kMaskColors.length].join()})`;
      label.append(name);
      input.addEventListener("change", () => {
        this.masksOn[input.checked ? "add" : "delete"](name);
        this.load(this.id);
      });
    });
    this.load(id);
  }

  async load(id) {
    this.id = id;
    this.box.dataset.ready = "false";
    this.pictureChoice.value = id;
    const { set } = this, picture = set.pictures.find(p => p.id === id);
    const otherPicture = set.pictures.find(p => p.id === this.otherChoice.value);
    const masks = set.masks.filter(mask => this.masksOn.has(mask.name));
    const shown = await Promise.all([picture && picture.uri, (otherPicture || set.reference).uri,
      otherPicture ? null : picture && picture.map, ...masks.map(mask => mask.uri)].map(decodePicture));
    // Another choice may have come first.
    if (this.id !== id || this.set !== set) return;
    const colorOf = mask => kMaskColors[set.masks.indexOf(mask) % kMaskColors.length];
    this.shown = { picture: shown[0], other: shown[1], map: shown[2],
      masks: shown.slice(3).flatMap((mask, i) => mask ? [maskCanvas(mask, colorOf(masks[i]))] : []) };
    this.names = [picture ? picture.name : "", (otherPicture || set.reference).name];
    this.computed = {};
    const otherButton = this.modes.buttons.find(button => button.dataset.value === "other");
    otherButton.textContent = otherPicture ? "other" : "reference";
    const needs = { picture: shown[0], other: shown[1], flip: shown[2] };
    for (const button of this.modes.buttons) {
      const { value } = button.dataset;
      button.disabled = value in needs ? !needs[value] : !(shown[0] && shown[1]);
    }
    this.layOut();
    this.box.dataset.ready = "true";
  }

  // ---- Drawing

  /// Fits the canvas to its width and the picture's shape.
  layOut() {
    const { picture, other } = this.shown, size = picture || other, width = this.canvas.clientWidth;
    if (!width) return;
    const shape = size ? size.height / size.width : 9 / 16;
    const isStacked = this.isStacked(), most = (document.fullscreenElement || isStacked ? 0.86 : 0.75) * innerHeight;
    const wanted = this.viewSize().width * shape * (isStacked ? 2 : 1) + (isStacked ? kGap : 0);
    const height = Math.round(Math.max(160, Math.min(most, wanted)));
    this.canvas.style.height = height + "px";
    this.canvas.width = Math.round(width * devicePixelRatio);
    this.canvas.height = Math.round(height * devicePixelRatio);
    this.draw();
  }

  /// What each view of the canvas shows, from left to right.
  views() {
    const { picture, other, map } = this.shown, { mode, gain } = this.state, { computed } = this;
    const imageOf = shown => shown && shown.image;
    if (mode === "difference" && picture && other) {
      if (computed.gain !== gain) Object.assign(computed, { gain, difference: differenceCanvas(picture, other, gain) });
      return [computed.difference];
    }
    if (mode === "flip" && map) return [computed.map = computed.map || mapCanvas(map)];
    if (mode === "side" || mode === "divider") return [imageOf(picture), imageOf(other)];
    return [imageOf(mode === "other" ? other : picture)];
  }

  draw() {
    const { state, canvas } = this, { picture, other } = this.shown, size = picture || other;
    const context = canvas.getContext("2d"), scale = devicePixelRatio;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    if (size) {
      if (state.isFitted) Object.assign(state, { zoom: this.fittingZoom(), x: size.width / 2, y: size.height / 2 });
      state.x = Math.max(0, Math.min(size.width, state.x));
      state.y = Math.max(0, Math.min(size.height, state.y));
    }
    const { width, height } = this.viewSize(), cut = state.divider * width;
    const [first, second] = this.views(), whole = { left: 0, top: 0, width, height };
    if (state.mode === "divider") {
      this.drawView(context, first, whole, 0, cut);
      this.drawView(context, second, whole, cut, width);
      context.fillStyle = "#fff";
      context.fillRect(cut - 1, 0, 2, height);
      context.fillRect(cut - 4, height / 2 - 14, 8, 28);
    } else {
      this.drawView(context, first, whole, 0, width);
      const place = this.isStacked() ? { top: height + kGap } : { left: width + kGap };
      if (state.mode === "side") this.drawView(context, second, { ...whole, ...place }, 0, width);
    }
    this.tell();
  }

  /// The image, and the masks over it, in a view: {left, top, width, height}, px of the canvas; only its columns from
  /// `begin` to `end`.
  drawView(context, image, view, begin, end) {
    const { state } = this;
    context.save();
    context.beginPath();
    context.rect(view.left + begin, view.top, Math.max(0, end - begin), view.height);
    context.clip();
    context.imageSmoothingEnabled = state.zoom * devicePixelRatio < 1;
    context.imageSmoothingQuality = "high";
    const { left, top, width, height } = view;
    context.translate(left + width / 2 - state.x * state.zoom, top + height / 2 - state.y * state.zoom);
    context.scale(state.zoom, state.zoom);
    if (image) context.drawImage(image, 0, 0);
    for (const mask of this.shown.masks || []) context.drawImage(mask, 0, 0);
    context.restore();
  }

  /// Everything beside the canvas: sliders, zoom, the values under the pointer; and the state, for who reads elements.
  tell() {
    const { state, shown } = this;
    Object.assign(this.box.dataset, { mode: state.mode, zoom: state.zoom.toFixed(3), gain: state.gain });
    // A finger on the whole picture scrolls the page.
    this.canvas.style.touchAction = state.isFitted ? "pan-y" : "none";
    this.dividerSlider.label.hidden = state.mode !== "divider";
    this.dividerSlider.text.textContent = Math.round(100 * state.divider) + " %";
    this.gainSlider.label.hidden = state.mode !== "difference";
    this.gainSlider.text.textContent = "×" + state.gain;
    this.mapScale.hidden = state.mode !== "flip";
    this.zoomText.textContent = percent(state.zoom * devicePixelRatio);
    const names = this.names || ["", ""];
    this.canvas.setAttribute("aria-label", `${state.mode}: ${names[0]} against ${names[1]}`);
    this.readOut.textContent = shown.picture || shown.other ? this.valuesAt(this.pointer, names) : "No picture here.";
  }

  valuesAt(pointer, names) {
    const { state, shown } = this, size = shown.picture || shown.other;
    if (!shown.picture) return `No picture of ${names[0]} in this file; ${names[1]} is shown.`;
    const idle = `${names[0]} against ${names[1]}. Point at a pixel for its values.`;
    if (!pointer) return idle;
    const from = this.fromCenter(pointer.x, pointer.y);
    const x = Math.floor(from.x / state.zoom + state.x), y = Math.floor(from.y / state.zoom + state.y);
    if (x < 0 || y < 0 || x >= size.width || y >= size.height) return idle;
    const at = picture => Array.from(picture.pixels.subarray(4 * (y * size.width + x)).subarray(0, 3));
    const parts = [`pixel ${x}, ${y}`, `${names[0]}: ${at(shown.picture).join(" ")}`];
    if (shown.other) parts.push(`${names[1]}: ${at(shown.other).join(" ")}`);
    if (shown.map) parts.push(`FLIP: ${(at(shown.map)[0] / 255).toFixed(3)}`);
    return parts.join(" · ");
  }
}
const makePictureViewer = (box, select) => new PictureViewer(box, select);
