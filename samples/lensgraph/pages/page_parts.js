// What pages with a picture viewer share: the data, numbers in words, the switch of light and dark, the box of details.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);

// ---- Numbers. Files hold those that are not finite as strings, and absent ones as null.

/// A number of a file; null when it is absent or not a number.
function numberOf(value) {
  if (typeof value === "number") return value;
  if (value === "infinity") return Infinity;
  return value === "-infinity" ? -Infinity : null;
}
const kNone = "–";
/// With that many decimals; "∞" for infinity.
function fixed(value, digits) {
  if (value === null || value === undefined) return kNone;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  return value.toFixed(digits).replace("-", "−");
}
/// With three digits or all those before the point.
function brief(value) {
  if (value === null || value === undefined) return kNone;
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 0.001) return value.toExponential(1);
  return fixed(value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}
const percent = share => share === null || share === undefined ? kNone : brief(100 * share) + " %";
function bytes(count) {
  if (count === null || count === undefined) return kNone;
  const power = count < 1024 ? 0 : Math.min(4, Math.floor(Math.log2(count) / 10));
  return power === 0 ? `${count} B` : `${brief(count / 1024 ** power)} ${["", "KiB", "MiB", "GiB", "TiB"][power]}`;
}

// ---- Elements

/// A new element below another: element(parent, "button", {class: "x", "aria-pressed": true}, "text").
function element(parent, tag, attributes = {}, text = null) {
  const created = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) created.setAttribute(name, value);
  if (text !== null) created.textContent = text;
  if (parent) parent.append(created);
  return created;
}

/// Buttons of which one is pressed; `choose` is called with its value. Returns a function that presses another.
function choice(parent, label, values, chosen, choose) {
  const group = element(parent, "span", { class: "group", role: "group", "aria-label": label });
  const buttons = values.map(({ value, text, title }) => {
    const button = element(group, "button", { type: "button", "data-value": value }, text);
    if (title) button.title = title;
    button.addEventListener("click", () => { press(value); choose(value); });
    return button;
  });
  const press = value => buttons.forEach(b => b.setAttribute("aria-pressed", b.dataset.value === String(value)));
  press(chosen);
  return { press, buttons, group };
}

/// A labelled <select>; `values`: {value, text}. Calls `choose` with the value.
function selection(parent, label, values, chosen, choose) {
  const box = element(parent, "label");
  element(box, "span", {}, label + " ");
  const select = element(box, "select");
  for (const { value, text } of values) element(select, "option", { value }, text);
  select.value = chosen;
  select.addEventListener("change", () => choose(select.value));
  return select;
}

function fact(parent, what, value) {
  const item = element(parent, "span");
  element(item, "span", {}, what + " ");
  element(item, "b", {}, value);
}

/// Calls `draw` with the width of the box, now and when the box has another.
function drawToWidth(box, draw) {
  let width = 0;
  const redraw = () => {
    if (box.clientWidth === width || box.clientWidth === 0) return;
    width = box.clientWidth;
    draw(width);
  };
  // Not at once: what is drawn may change sizes, of which an observer in its own turn complains.
  new ResizeObserver(() => requestAnimationFrame(redraw)).observe(box);
  redraw();
}

// ---- Light and dark: as the system has it until the button is pressed.

function addThemeButton(parent) {
  const root = document.documentElement, dark = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => root.dataset.theme ? root.dataset.theme === "dark" : dark.matches;
  const button = element(parent, "button", { type: "button", id: "theme" });
  const tell = () => {
    button.textContent = isDark() ? "☀ light" : "☾ dark";
    button.setAttribute("aria-label", isDark() ? "switch to light colors" : "switch to dark colors");
  };
  button.addEventListener("click", () => { root.dataset.theme = isDark() ? "light" : "dark"; tell(); });
  dark.addEventListener("change", tell);
  tell();
}

// ---- The box of details of what is hovered or has the focus

const tip = element(document.body, "div", { id: "tip", role: "tooltip" });
function placeTip(x, y) {
  const box = tip.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - box.width - 8)) + "px";
  tip.style.top = Math.max(4, y + 16 + box.height > innerHeight ? y - box.height - 12 : y + 16) + "px";
}
function hideTip() { tip.style.visibility = "hidden"; }
/// Shows the title and the lines while the mouse is over the element, or it has the focus. `about()` gives both.
function explain(target, about) {
  const show = () => {
    const [title, lines] = about();
    tip.replaceChildren();
    element(tip, "b", {}, title);
    element(tip, "span", {}, lines.join("\n"));
    tip.style.visibility = "visible";
  };
  target.addEventListener("mouseenter", event => { show(); placeTip(event.clientX, event.clientY); });
  target.addEventListener("mousemove", event => placeTip(event.clientX, event.clientY));
  target.addEventListener("mouseleave", hideTip);
  target.addEventListener("focus", () => {
    if (!target.matches(":focus-visible")) return;
    const box = target.getBoundingClientRect();
    show();
    placeTip(box.right, box.top);
  });
  target.addEventListener("blur", hideTip);
}
document.addEventListener("keydown", event => { if (event.key === "Escape") hideTip(); });
