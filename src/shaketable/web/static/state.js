// What is asked: all of it is in the address of the page, so that a link carries it.

// Of each number: its least and largest value, its step on the slider and what it is by default.
export const FIELDS = {
  width_m: { least: 0.02, most: 3, step: 0.01, given: 0.32, length: true, text: "width" },
  height_m: { least: 0.05, most: 4, step: 0.01, given: 1.8, length: true, text: "height" },
  cg_share: { least: 0.1, most: 0.9, step: 0.01, given: 0.5, text: "cg" },
  eccentricity: { least: 0.1, most: 0.9, step: 0.01, given: 0.5, text: "side" },
  tilt_deg: { least: 0, most: 15, step: 0.25, given: 0, unit: "°", text: "tilt" },
  friction: { least: 0.05, most: 1.5, step: 0.05, given: 0.5, text: "friction" },
  scale: { least: 0.1, most: 4, step: 0.05, given: 1, text: "scale" },
  period_s: { least: 0.1, most: 4, step: 0.05, given: 0.8, unit: "s", text: "period" },
  peak_g: { least: 0.05, most: 3, step: 0.05, given: 0.4, unit: "g", text: "peak" },
};

export function begin() {
  const state = { kind: "recording", name: "", reverse: false, slides: true, uploaded: null };
  for (const [name, field] of Object.entries(FIELDS)) state[name] = field.given;
  const told = new URLSearchParams(location.hash.slice(1));
  for (const [name, field] of Object.entries(FIELDS)) {
    const value = Number(told.get(name));
    if (told.has(name) && value >= field.least && value <= field.most) state[name] = value;
  }
  if (["recording", "pulse"].includes(told.get("kind"))) state.kind = told.get("kind");
  state.name = (told.get("name") ?? "").slice(0, 120);
  state.reverse = told.get("reverse") === "1";
  state.slides = told.get("slides") !== "0";
  return state;
}

export function keep(state) {
  const told = new URLSearchParams();
  for (const [name, field] of Object.entries(FIELDS)) {
    if (state[name] !== field.given) told.set(name, state[name]);
  }
  if (state.kind === "pulse") told.set("kind", "pulse");
  if (state.kind === "recording" && state.name) told.set("name", state.name);
  if (state.reverse) told.set("reverse", "1");
  if (!state.slides) told.set("slides", "0");
  history.replaceState(null, "", `${location.pathname}${location.search}#${told}`);
}

export function thingOf(state) {
  const { width_m, height_m, cg_share, eccentricity, tilt_deg } = state;
  return { width_m, height_m, cg_share, eccentricity, tilt_deg, friction: state.slides ? state.friction : null };
}

export function shakingOf(state) {
  if (state.kind === "pulse") return { kind: "pulse", period_s: state.period_s, peak_g: state.peak_g };
  if (state.kind === "uploaded") return { kind: "uploaded", ...state.uploaded };
  return { kind: "recording", name: state.name };
}
