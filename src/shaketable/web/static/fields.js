// The fields of the form: a number with a slider, in the units that were chosen.

import { FIELDS, SHAPES } from "./state.js";
import { helpOf, numberIn, say, written } from "./texts.js";

// A field for a number of the state; `changed` is called when it has another one.
export function makeField(name, state, units, changed) {
  const field = FIELDS[name];
  const times = field.length && units === "cm" ? 100 : 1;
  const text = name === "base_m" ? SHAPES[state.shape].base : field.text;
  const made = document.createElement("div");
  made.className = "field";
  made.dataset.field = name;
  const label = Object.assign(document.createElement("label"), { htmlFor: name, textContent: say(text) });
  const value = Object.assign(document.createElement("span"), { className: "value" });
  const limits = { min: field.least * times, max: field.most * times };
  const box = Object.assign(document.createElement("input"), {
    // a box of the type number has the browser's decimal sign, not the page's
    type: "text", id: name, inputMode: "decimal", autocomplete: "off", value: written(state[name] * times),
  });
  Object.assign(box.dataset, limits);
  const slider = Object.assign(document.createElement("input"), {
    type: "range", min: field.from * times, max: field.to * times, step: field.step * times, value: state[name] * times,
  });
  slider.setAttribute("aria-label", say(text));
  const take = (given, show) => {
    const found = given / times;
    const right = found >= field.least - 1e-12 && found <= field.most + 1e-12;
    made.classList.toggle("wrong", !right);
    box.setAttribute("aria-invalid", String(!right));
    if (!right) return;
    state[name] = Number(found.toPrecision(12));
    show();
    changed();
  };
  box.addEventListener("input", () => {
    const given = numberIn(box.value);
    take(given, () => { slider.value = given; });
  });
  slider.addEventListener("input", () => take(Number(slider.value), () => { box.value = written(slider.value); }));
  value.append(box, field.length ? units : field.unit ?? "");
  made.append(label, value, slider);
  made.append(helpOf(`${text}_help`));
  return made;
}
