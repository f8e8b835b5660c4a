// The fields of what is selected in a plan, or of the room itself.

import { at } from "./room_geometry.js";
import { SECTIONS } from "./room_state.js";
import { make } from "./page.js";
import { numberIn, say, written } from "./texts.js";

const GRAVITY = 9.80665;
const FIRM = 2; // kN/m for each kg of a thing: the stiffer strap of those that are tried on each
const PADS = 0.25; // of the weight: what each of them holds

// Of each number: the least and largest value that is taken, and its unit.
const NUMBERS = {
  depth_m: [0.02, 5, "m"], width_m: [0.02, 5, "m"], diameter_m: [0.02, 5, "m"], height_m: [0.02, 5, "m"],
  mass_kg: [0.1, 100000, "kg"], facing_deg: [0, 360, "°"], turned_deg: [-360, 360, "°"], people: [0, 1000, ""],
  north_deg: [-360, 360, "°"], way_m: [0.3, 3, "m"], scatter_m: [0, 5, "m"], length: [1, 40, "m"], breadth: [1, 40, "m"],
};
const EMPTY = new Set(["north_deg", "mass_kg", "scatter_m", "people"]); // may be left out

function field(label, control, unit = "") {
  const made = make("div", "", { className: "field" });
  control.id = `field-${label}`;
  const value = make("span", "", { className: "value" });
  value.append(control, unit);
  made.append(make("label", say(`room_${label}`), { htmlFor: control.id }), value);
  return made;
}

function numberField(name, value, take) {
  const [least, most, unit] = NUMBERS[name];
  const box = make("input", "", { type: "text", inputMode: "decimal", autocomplete: "off", value: value === undefined ? "" : written(value) });
  const made = field(name, box, unit);
  box.addEventListener("change", () => {
    const given = box.value.trim() === "" && EMPTY.has(name) ? undefined : numberIn(box.value);
    const right = given === undefined || (given >= least && given <= most);
    made.classList.toggle("wrong", !right);
    box.setAttribute("aria-invalid", String(!right));
    if (right) take(given);
  });
  return made;
}

function textField(name, value, take) {
  const box = make("input", "", { type: "text", maxLength: 80, value: value ?? "" });
  const made = field(name, box);
  box.addEventListener("change", () => { // a name that is taken stays in the box, marked
    const wrong = !box.value.trim() || take(box.value.trim()) === false;
    made.classList.toggle("wrong", wrong);
    box.setAttribute("aria-invalid", String(wrong));
  });
  return made;
}

function choice(name, value, options, take) {
  const box = make("select");
  for (const [each, text] of options) box.append(new Option(text, each, false, each === value));
  box.addEventListener("change", () => take(box.value));
  return field(name, box);
}

function tick(name, value, take) {
  const box = make("input", "", { type: "checkbox", checked: value });
  box.addEventListener("change", () => take(box.checked));
  return field(name, box);
}

// By what a thing is held, as an inventory says it.
function heldBy(thing) {
  if (thing.anchored === "yes" || thing.anchored === true) return "anchored";
  if (thing.strap) return "strap";
  return thing.pad_n ? "pads" : "";
}

function held(thing, by) {
  const mass = thing.mass_kg ?? 50;
  const values = { anchored: undefined, strap: undefined, pad_n: undefined };
  if (by === "anchored") values.anchored = "yes";
  if (by === "strap") Object.assign(values, { strap: `top:slack=20mm,stiffness=${Math.round(FIRM * mass)}kN/m`, mass_kg: mass });
  if (by === "pads") Object.assign(values, { pad_n: Math.round(PADS * mass * GRAVITY), mass_kg: mass });
  return values;
}

const words = (name, kinds) => kinds.map((each) => [each, say(`room_${name}_${each || "none"}`)]);

// The fields of a plan's selection, into a place of the page.
export function showFields(place, plan) {
  const { element, edited, selected } = plan;
  const { room } = edited;
  if (!element) {
    place.replaceChildren(make("h3", say("room_itself")), ...fieldsOfRoom(edited));
    return;
  }
  const set = (values) => plan.change(values);
  const { section } = selected;
  const rename = (name) => {
    const before = element.name;
    if (SECTIONS.some((each) => (room[each] ?? []).some((one) => one !== element && one.name === name))) {
      return false;
    }
    edited.change(() => {
      element.name = name;
      for (const each of room.thing ?? []) if (each.on === before) each.on = name;
    });
    return true;
  };
  const numbers = (names) => names.map((name) => numberField(name, element[name], (value) => set({ [name]: value })));
  const fields = [make("h3", say(`room_${section}`)), textField("name", element.name, rename)];
  if (section === "door") {
    fields.push(
      ...numbers(["width_m"]),
      choice("swing", element.swing ?? "inward", words("swing", ["inward", "outward", "sliding"]), (swing) => set({ swing })),
      choice("hinge", element.hinge ?? "left", words("hinge", ["left", "right"]), (hinge) => set({ hinge })),
      tick("exit", element.exit ?? true, (exit) => set({ exit })));
  } else if (section === "place") {
    const size = (k) => numberField(k ? "breadth" : "length", element.size_m[k], (value) => {
      set({ size_m: element.size_m.map((each, j) => (j === k ? value : each)) });
    });
    fields.push(size(0), size(1), ...numbers(["turned_deg", "people"]));
  } else {
    const others = (room.thing ?? []).filter((each) => each !== element).map((each) => [each.name, each.name]);
    fields.push(
      ...numbers([...(element.diameter_m ? ["diameter_m"] : ["depth_m", "width_m"]), "height_m", "mass_kg", "facing_deg"]),
      choice("held", heldBy(element), words("held", ["", "strap", "pads", "anchored"]), (by) => set(held(element, by))),
      choice("castors", element.castors ?? "", words("castors", ["", "locked", "free"]), (castors) => set({ castors: castors || undefined })),
      tick("must_not_fall", element.must_not_fall === "yes" || element.must_not_fall === true, (must) => set({ must_not_fall: must ? "yes" : "no" })),
      choice("on", element.on ?? "", [["", say("room_on_none")], ...others], (on) => set({ on: on || undefined })));
  }
  place.replaceChildren(...fields);
}

function fieldsOfRoom(edited) {
  const { room } = edited;
  const set = (values) => edited.change(() => Object.assign(room, values));
  const [xs, ys] = [0, 1].map((k) => room.outline_m.map((each) => each[k]));
  const square = room.outline_m.length === 4 && new Set(xs).size === 2 && new Set(ys).size === 2;
  const fields = [textField("name", room.name ?? "", (name) => set({ name }))];
  const sized = (k, value) => {
    const all = k ? ys : xs, low = Math.min(...all), before = Math.max(...all);
    set({ outline_m: room.outline_m.map((corner) => corner.map((each, j) => (j === k && each === before ? low + value : each))) });
  };
  if (square) {
    fields.push(
      numberField("length", Math.max(...xs) - Math.min(...xs), (value) => sized(0, value)),
      numberField("breadth", Math.max(...ys) - Math.min(...ys), (value) => sized(1, value)));
  }
  const corner = make("button", say("room_corner"), { type: "button", className: "plain" });
  corner.addEventListener("click", () => set({ outline_m: withCorner(room.outline_m) }));
  fields.push(corner);
  for (const name of ["north_deg", "way_m", "scatter_m"]) fields.push(numberField(name, room[name], (value) => set({ [name]: value })));
  return fields;
}

// A corner more, in the middle of the longest wall.
function withCorner(corners) {
  const longest = corners.map(([x, y], k) => {
    const [u, v] = corners[(k + 1) % corners.length];
    return Math.hypot(u - x, v - y);
  });
  const k = longest.indexOf(Math.max(...longest));
  const [[x, y], [u, v]] = [corners[k], corners[(k + 1) % corners.length]];
  return [...corners.slice(0, k + 1), at((x + u) / 2, (y + v) / 2), ...corners.slice(k + 1)];
}
