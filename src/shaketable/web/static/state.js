// What is asked: all of it is in the address of the page, so that a link carries it.

// Of each number: the least and largest value that is taken, those of its slider and the slider's
// step, and what it is by default.
export const FIELDS = {
  base_m: { least: 0.005, most: 20, from: 0.02, to: 3, step: 0.01, given: 0.32, length: true, text: "base" },
  depth_m: { least: 0.005, most: 20, from: 0.02, to: 3, step: 0.01, given: 0.32, length: true, text: "depth" },
  width_m: { least: 0.005, most: 20, from: 0.02, to: 3, step: 0.01, given: 0.9, length: true, text: "width" },
  height_m: { least: 0.005, most: 20, from: 0.05, to: 4, step: 0.01, given: 1.8, length: true, text: "height" },
  cg_share: { least: 0.01, most: 0.99, from: 0.1, to: 0.9, step: 0.01, given: 0.5, text: "cg" },
  eccentricity: { least: 0.01, most: 0.99, from: 0.1, to: 0.9, step: 0.01, given: 0.5, text: "side" },
  facing_deg: { least: -360, most: 360, from: 0, to: 180, step: 5, given: 0, unit: "°", text: "facing" },
  tilt_deg: { least: 0, most: 30, from: 0, to: 15, step: 0.25, given: 0, unit: "°", text: "tilt" },
  friction: { least: 0.02, most: 5, from: 0.05, to: 1.5, step: 0.05, given: 0.5, text: "friction" },
  rolling_friction_mm: { least: 0, most: 50, from: 0, to: 10, step: 0.1, given: 0, unit: "mm", text: "rolling" },
  contour_friction_mm: { least: 0, most: 50, from: 0, to: 2, step: 0.02, given: 0, unit: "mm", text: "contour" },
  wall_gap_mm: { least: 0, most: 2000, from: 0, to: 500, step: 5, given: 10, unit: "mm", text: "wall_gap" },
  strap_slack_mm: { least: 0, most: 500, from: 0, to: 100, step: 1, given: 5, unit: "mm", text: "strap_slack" },
  strap_stiffness_kn_m: { least: 1, most: 500, from: 5, to: 250, step: 5, given: 50, unit: "kN/m", text: "strap_stiffness" },
  edge_mm: { least: 0, most: 2000, from: 0, to: 500, step: 5, given: 50, unit: "mm", text: "edge_gap" },
  lip_mm: { least: 0, most: 500, from: 0, to: 100, step: 1, given: 0, unit: "mm", text: "lip" },
  scale: { least: 0, most: 20, from: 0.1, to: 4, step: 0.05, given: 1, text: "scale" },
  period_s: { least: 0.05, most: 10, from: 0.1, to: 4, step: 0.05, given: 0.8, unit: "s", text: "period" },
  peak_g: { least: 0.001, most: 5, from: 0.05, to: 3, step: 0.05, given: 0.4, unit: "g", text: "peak" },
};

// Of each shape: the numbers that it has, and what its base is called.
export const SHAPES = {
  side: { fields: ["base_m", "height_m", "cg_share", "eccentricity", "tilt_deg"], base: "base" },
  box: { fields: ["depth_m", "width_m", "height_m", "cg_share", "facing_deg", "tilt_deg"] },
  cylinder: { fields: ["base_m", "height_m", "cg_share", "tilt_deg", "rolling_friction_mm", "contour_friction_mm"], base: "diameter" },
};

// What may stand beside a thing, with the numbers that it has.
export const BESIDE = { wall: ["wall_gap_mm"], strap: ["strap_slack_mm", "strap_stiffness_kn_m"], edge: ["edge_mm", "lip_mm"] };

// The numbers of what stands beside a thing.
export function besideOf(state) {
  return Object.entries(BESIDE).filter(([what]) => state[what]).flatMap(([, fields]) => fields);
}

export function begin() {
  const state = { shape: "box", kind: "recording", name: "", reverse: false, slides: false, uploaded: null, unusable: false };
  for (const [name, field] of Object.entries(FIELDS)) state[name] = field.given;
  const told = new URLSearchParams(location.hash.slice(1));
  // what is no box had its base as a width in links of before
  if (told.get("shape") !== "box" && told.has("width_m") && !told.has("base_m")) told.set("base_m", told.get("width_m"));
  for (const [name, field] of Object.entries(FIELDS)) {
    const value = Number(told.get(name));
    if (!told.has(name)) continue;
    if (value >= field.least && value <= field.most) state[name] = value;
    else state.unusable = true;
  }
  // links of before the page began with a box say no shape: they are seen from the side
  const old = told.size > 0 && !told.has("shape");
  if (old) state.shape = "side";
  if (Object.hasOwn(SHAPES, told.get("shape") ?? "")) state.shape = told.get("shape");
  if (["recording", "pulse"].includes(told.get("kind"))) state.kind = told.get("kind");
  state.name = (told.get("name") ?? "").slice(0, 120);
  state.reverse = told.get("reverse") === "1";
  state.slides = old ? told.get("slides") !== "0" : told.get("slides") === "1";
  for (const what of Object.keys(BESIDE)) state[what] = told.get(what) === "1";
  return state;
}

export function keep(state) {
  const told = new URLSearchParams();
  told.set("shape", state.shape);
  for (const [name, field] of Object.entries(FIELDS)) {
    if (state[name] !== field.given) told.set(name, state[name]);
  }
  if (state.kind === "pulse") told.set("kind", "pulse");
  if (state.kind === "recording" && state.name) told.set("name", state.name);
  if (state.reverse) told.set("reverse", "1");
  if (state.slides) told.set("slides", "1");
  for (const what of Object.keys(BESIDE)) if (state[what]) told.set(what, "1");
  history.replaceState(null, "", `${location.pathname}${location.search}#${told}`);
}

// The thing as the interface takes it; one in three dimensions has a shape.
export function thingOf(state) {
  const thing = Object.fromEntries(SHAPES[state.shape].fields.map((name) => [name, state[name]]));
  thing.friction = state.slides ? state.friction : null;
  const beside = besideOf(state);
  if (beside.length) thing.beside = Object.fromEntries(beside.map((name) => [name, state[name]]));
  return state.shape === "side" ? thing : { shape: state.shape, ...thing };
}

// Another shape: its size along the shaking stays.
export function changeShape(state, shape) {
  if (shape === "box" && state.shape !== "box") state.depth_m = state.base_m;
  if (shape !== "box" && state.shape === "box") state.base_m = state.depth_m;
  state.shape = shape;
}

// The sizes of a thing's base along x, from its front to its back, and along y.
export function basesOf(thing) {
  return thing.base_m === undefined || thing.base_m === null ? [thing.depth_m, thing.width_m] : [thing.base_m, thing.base_m];
}

// The question that is asked of a thing: "simulate" or "many".
export function pathOf(thing, question) {
  return thing.shape ? `space/${question}` : question;
}

export function shakingOf(state) {
  if (state.kind === "pulse") return { kind: "pulse", period_s: state.period_s, peak_g: state.peak_g };
  if (state.kind === "uploaded") return { kind: "uploaded", ...state.uploaded };
  return { kind: "recording", name: state.name };
}
