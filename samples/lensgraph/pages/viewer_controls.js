// What the user does with the picture viewer: its buttons, sliders, keys and the mouse. picture_viewer.js does what they
// ask.

const kModes = [
  { value: "picture", text: "picture", title: "the picture alone (1); the space bar blinks to the other one" },
  { value: "other", text: "reference", title: "the other picture alone (2)" },
  { value: "divider", text: "divider", title: "the picture left of the divider, the other one right of it (3)" },
  { value: "side", text: "both", title: "both, side by side or one below the other; they move together (4)" },
  { value: "difference", text: "difference", title: "absolute difference of the displayed colors, times the gain (5)" },
  { value: "flip", text: "FLIP", title: "the picture's FLIP map against the reference (6)" },
];

class ViewerControls {
  constructor(box, select) {
    this.box = box;
    this.select = select;
    box.classList.add("viewer");
  }

  toggleFullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.box.requestFullscreen();
  }

  addControls() {
    const names = element(this.box, "div", { class: "row names" });
    this.pictureChoice = selection(names, "picture", [], null, id => { this.select(id); this.load(id); });
    this.otherChoice = selection(names, "against", [], null, () => this.load(this.id));
    this.modes = choice(element(this.box, "div", { class: "row" }), "what is shown", kModes, this.state.mode,
      mode => this.setMode(mode));
    const zooms = element(this.modes.group.parentNode, "span", { class: "group", role: "group", "aria-label": "zoom" });
    const zoomButton = (text, label, act) => {
      const button = element(zooms, "button", { type: "button", "aria-label": label, title: label }, text);
      button.addEventListener("click", act);
      return button;
    };
    zoomButton("−", "zoom out", () => this.zoomBy(0.5));
    zoomButton("fit", "whole picture", () => this.fit());
    zoomButton("1:1", "one pixel of the picture on one of the screen", () => this.zoomTo(1 / devicePixelRatio));
    zoomButton("+", "zoom in", () => this.zoomBy(2));
    const screen = zoomButton("full", "full screen", () => this.toggleFullScreen());
    screen.hidden = !document.fullscreenEnabled;
    this.zoomText = element(zooms, "span", { class: "quiet number" });
  }

  addCanvas() {
    this.canvas = element(this.box, "canvas", { tabindex: "0", role: "img", "aria-label": "picture" });
    const sliders = element(this.box, "div", { class: "row" });
    const slider = (name, options, value, act) => {
      const label = element(sliders, "label", { class: "row" });
      element(label, "span", {}, name);
      const input = element(label, "input", { type: "range", ...options, value });
      const text = element(label, "span", { class: "number" });
      input.addEventListener("input", () => { act(Number(input.value)); this.draw(); });
      return { label, input, text };
    };
    this.dividerSlider = slider("divider", { min: 0, max: 100, step: 0.5 }, 50, v => { this.state.divider = v / 100; });
    this.gainSlider = slider("gain", { min: 0, max: 6, step: 1 }, 2, v => { this.state.gain = 2 ** v; });
    this.mapScale = element(sliders, "span", { class: "quiet" }, "FLIP 0");
    const colors = d3.range(0, 256, 32).concat(255).map(i => `rgb(${kMapColors[i].join()})`);
    element(this.mapScale, "i", { class: "scale" }).style.background = `linear-gradient(90deg, ${colors.join()})`;
    this.mapScale.append("1");
    this.maskBox = element(this.box, "div", { class: "row", role: "group", "aria-label": "masks" });
    this.readOut = element(this.box, "div", { class: "read-out quiet" });
    const help = element(this.box, "details");
    element(help, "summary", {}, "Keys and mouse");
    const keys = element(help, "p", { class: "quiet" });
    keys.innerHTML = "With the picture in focus (click it or tab to it): <kbd>1</kbd>–<kbd>6</kbd> choose what is " +
      "shown, <kbd>space</kbd> blinks between the two pictures, <kbd>+</kbd> <kbd>−</kbd> or the wheel zoom, " +
      "<kbd>0</kbd> fits, arrows or dragging move, <kbd>[</kbd> <kbd>]</kbd> or dragging move the divider, " +
      "<kbd>g</kbd> <kbd>G</kbd> change the gain, <kbd>f</kbd> fills the screen. Magnified pixels are shown as they are.";
    this.addPointer();
    this.canvas.addEventListener("keydown", event => this.onKey(event));
    this.canvas.addEventListener("wheel", event => {
      // Without focus the wheel scrolls the page, as a reader expects.
      if (document.activeElement !== this.canvas && !event.ctrlKey) return;
      event.preventDefault();
      this.zoomBy(2 ** (-event.deltaY / 240), event.offsetX, event.offsetY);
    }, { passive: false });
  }

  addPointer() {
    let drag = null;
    this.canvas.addEventListener("pointerdown", event => {
      const onDivider = this.state.mode === "divider" &&
        Math.abs(event.offsetX - this.state.divider * this.canvas.clientWidth) < 12;
      drag = { onDivider, x: event.offsetX, y: event.offsetY };
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", event => {
      this.pointer = { x: event.offsetX, y: event.offsetY };
      if (drag && drag.onDivider) {
        this.moveDivider(event.offsetX / this.canvas.clientWidth);
      } else if (drag) {
        this.moveBy((drag.x - event.offsetX) / this.state.zoom, (drag.y - event.offsetY) / this.state.zoom);
        [drag.x, drag.y] = [event.offsetX, event.offsetY];
      }
      this.tell();
    });
    const end = () => { drag = null; };
    this.canvas.addEventListener("pointerup", end);
    this.canvas.addEventListener("pointercancel", end);
    this.canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tell(); });
    this.canvas.addEventListener("dblclick", () => { if (this.state.isFitted) this.zoomBy(4); else this.fit(); });
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 40 / this.state.zoom;
    const acts = {
      "+": () => this.zoomBy(2), "=": () => this.zoomBy(2), "-": () => this.zoomBy(0.5), "0": () => this.fit(),
      ArrowLeft: () => this.moveBy(-step, 0), ArrowRight: () => this.moveBy(step, 0),
      ArrowUp: () => this.moveBy(0, -step), ArrowDown: () => this.moveBy(0, step),
      "[": () => this.moveDivider(this.state.divider - 0.02), "]": () => this.moveDivider(this.state.divider + 0.02),
      g: () => this.setGain(this.state.gain / 2), G: () => this.setGain(this.state.gain * 2),
      f: () => this.toggleFullScreen(),
      " ": () => this.setMode(this.state.mode === "picture" ? "other" : "picture"),
    };
    const mode = kModes[Number(event.key) - 1];
    const act = acts[event.key] || (mode && (() => this.setMode(mode.value)));
    if (!act) return;
    event.preventDefault();
    act();
  }
}
