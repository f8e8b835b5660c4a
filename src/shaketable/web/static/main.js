// The page: fields, questions and their answers.

import { Refused, ask, motions, read } from "./api.js";
import { axes } from "./chart.js";
import { draw, lengthOf, poseAt, startOf } from "./scene.js";
import { FIELDS, begin, keep, shakingOf, thingOf } from "./state.js";
import { fixed, helpOf, inHundred, number, say, speak } from "./texts.js";

const find = (id) => document.getElementById(id);
const state = begin();
const still = matchMedia("(prefers-reduced-motion: reduce)");
const view = { film: null, thing: thingOf(state), time: 0, playing: false, shares: null, listed: [] };
let units = "cm";
let showTrace = () => {};
let live = null; // the question about 100 shakings that is on its way

const factor = (field) => (field.length && units === "cm" ? 100 : 1);
const unitOf = (field) => (field.length ? units : field.unit ?? "");
const metres = (value) => `${number(value * (units === "cm" ? 100 : 1))} ${units}`;

function makeField(name, place) {
  const field = FIELDS[name];
  const times = factor(field);
  const made = document.createElement("div");
  made.className = "field";
  made.dataset.field = name;
  const label = Object.assign(document.createElement("label"), { htmlFor: name, textContent: say(field.text) });
  const value = Object.assign(document.createElement("span"), { className: "value" });
  const box = Object.assign(document.createElement("input"), {
    type: "number", id: name, min: field.least * times, max: field.most * times, step: "any",
    value: Number((state[name] * times).toPrecision(6)), inputMode: "decimal",
  });
  const slider = Object.assign(document.createElement("input"), {
    type: "range", min: field.least * times, max: field.most * times, step: field.step * times,
    value: state[name] * times,
  });
  slider.setAttribute("aria-label", say(field.text));
  const take = (given, other) => {
    const found = Number(given.value) / times;
    const right = given.value !== "" && found >= field.least - 1e-12 && found <= field.most + 1e-12;
    made.classList.toggle("wrong", !right);
    box.setAttribute("aria-invalid", String(!right));
    if (!right) return;
    state[name] = Number(found.toPrecision(12));
    other.value = given.value;
    changed();
  };
  box.addEventListener("input", () => take(box, slider));
  slider.addEventListener("input", () => take(slider, box));
  value.append(box, unitOf(field));
  made.append(label, value, slider);
  if (field.text !== "scale") made.append(helpOf(`${field.text}_help`));
  place.append(made);
}

function makeFields() {
  const legend = find("thing").querySelector("legend");
  find("thing").replaceChildren(legend);
  for (const name of ["width_m", "height_m", "cg_share", "eccentricity", "tilt_deg"]) makeField(name, find("thing"));
  const slides = document.createElement("label");
  const box = Object.assign(document.createElement("input"), { type: "checkbox", id: "slides", checked: state.slides });
  box.addEventListener("change", () => { state.slides = box.checked; showKind(); changed(); });
  slides.append(box, ` ${say("slides")}`);
  find("thing").append(slides);
  makeField("friction", find("thing"));
  find("shaking-fields").replaceChildren();
  for (const name of ["period_s", "peak_g", "scale"]) makeField(name, find("shaking-fields"));
  showKind();
}

function showKind() {
  for (const radio of document.querySelectorAll("[name=kind]")) radio.checked = radio.value === state.kind;
  for (const each of document.querySelectorAll("[data-kind]")) each.hidden = each.dataset.kind !== state.kind;
  for (const name of ["period_s", "peak_g"]) {
    document.querySelector(`[data-field=${name}]`).hidden = state.kind !== "pulse";
  }
  document.querySelector("[data-field=friction]").hidden = !state.slides;
  find("no-sliding").hidden = state.slides;
  find("reverse").checked = state.reverse;
}

function changed() {
  keep(state);
  find("no-sliding").hidden = state.slides;
  if (!view.film) { view.thing = thingOf(state); redraw(); }
  const hundred = JSON.stringify([thingOf(state), state.scale]);
  if (view.shares && hundred !== view.hundred) later(askHundred);
  if (find("look").open) later(look);
}

// Asks once the sliders have come to rest.
const timers = new Map();
function later(what) {
  clearTimeout(timers.get(what));
  timers.set(what, setTimeout(what, 200));
}

function listMotions() {
  const select = find("name");
  select.replaceChildren();
  const groups = new Map();
  for (const each of view.listed) {
    if (!groups.has(each.suite)) groups.set(each.suite, Object.assign(document.createElement("optgroup"), { label: each.suite }));
    const text = `${each.name} · ${number(each.peak_g)} g · ${number(each.duration_s)} s`;
    groups.get(each.suite).append(new Option(text, each.name, false, each.name === state.name));
  }
  select.append(...groups.values());
}

function fail(place, error) {
  if (error.name === "AbortError") return;
  place.className = "verdict";
  place.textContent = error instanceof Refused && error.message ? say("failed", { detail: error.message }) : say("offline");
}

async function shake() {
  const verdict = find("verdict");
  if (state.kind === "uploaded" && !state.uploaded) return find("file").focus();
  const thing = thingOf(state);
  find("shake").disabled = true;
  verdict.className = "verdict";
  verdict.textContent = say("shaking_now");
  try {
    const waits = (wait) => { verdict.textContent = say("busy", { wait }); };
    const film = await ask("simulate", {
      thing, shaking: shakingOf(state), scale: state.scale, reverse: state.reverse,
    }, { waits });
    Object.assign(view, { film, thing, time: startOf(film), playing: !still.matches });
    if (still.matches) view.time = lengthOf(film);
    showFilm();
    find("result-title").scrollIntoView({ block: "nearest", behavior: still.matches ? "auto" : "smooth" });
    if (view.playing) run();
  } catch (error) {
    fail(verdict, error);
  } finally {
    find("shake").disabled = false;
  }
}

function sentence(film) {
  if (film.outcome !== "standing") return say(`falls_${film.outcome}`, { time: number(film.time_s, 3) });
  const values = { peak: number(film.peak_deg), tips: number(film.tips_at_deg), slip: metres(film.slip_m) };
  const rocks = film.peak_deg > 0.01, slid = film.slip_m > 0.001;
  if (rocks) return say(slid ? "stands_slid" : "stands", values);
  return say(slid ? "slid" : "stands_still", values);
}

function showFilm() {
  const { film } = view;
  if (!film) { find("verdict").textContent = say("none"); return; }
  find("verdict").className = `verdict ${film.outcome === "standing" ? "stands" : "falls"}`;
  const jump = film.lift_m > 0.001 ? ` ${say("jumps", { lift: metres(film.lift_m) })}` : "";
  find("verdict").textContent = sentence(film) + jump;
  find("one-shaking").hidden = false;
  find("film").hidden = false;
  const { acceleration_g, time_step_s, peak_g, name } = film.ground;
  const end = Math.max(lengthOf(film), (acceleration_g.length - 1) * time_step_s);
  find("time").max = lengthOf(film);
  const chart = axes(find("trace"), {
    x: [0, end], y: [-peak_g || -1, peak_g || 1], xText: `${say("time")} [${say("seconds")}]`, yText: "g",
    label: `${say("trace")}: ${name}`, format: (value) => number(value),
  });
  chart.line(acceleration_g.map((a, k) => [k * time_step_s, a]));
  showTrace = chart.cursor();
  showMoment();
}

function showMoment() {
  find("time").value = view.time;
  find("now").textContent = `${fixed(view.time)} ${say("seconds")}`;
  find("play").textContent = say(view.playing ? "pause" : "play");
  showTrace(view.time);
  redraw();
}

function redraw() {
  const { film, thing, time } = view;
  const rest = { x: 0, y: thing.cg_share * thing.height_m, ground: 0, turn: 0 };
  draw(find("scene"), thing, film ? poseAt(film, thing, time) : rest, metres);
}

let last = 0, loop = 0;
function run() {
  cancelAnimationFrame(loop);
  last = 0;
  loop = requestAnimationFrame(play);
}

function play(now) {
  if (!view.playing || !view.film) { last = 0; return; }
  if (last) view.time = Math.min(view.time + (now - last) / 1000, lengthOf(view.film));
  last = now;
  if (view.time >= lengthOf(view.film)) { view.playing = false; last = 0; }
  showMoment();
  if (view.playing) loop = requestAnimationFrame(play);
}

async function askHundred() {
  live?.abort();
  live = new AbortController();
  view.hundred = JSON.stringify([thingOf(state), state.scale]);
  const { signal } = live;
  find("shares").hidden = false;
  try {
    view.shares ??= {};
    const waits = (wait) => { find("share").textContent = say("busy", { wait }); };
    view.shares = await ask("many", { thing: thingOf(state), scale: state.scale }, { signal, waits });
    showShares();
  } catch (error) {
    if (error.name === "AbortError") return;
    for (const id of ["sure", "sides", "curve", "curve-help"]) find(id).replaceChildren();
    fail(find("share"), error);
  }
}

function showShares() {
  const found = view.shares;
  if (!found?.curve) return;
  const values = {
    falls: number(found.falls, 4), simulations: number(found.simulations, 4), share: inHundred(found.share),
    recordings: found.recordings, low: inHundred(found.low), high: inHundred(found.high),
    left: found.left, right: found.falls - found.left, pga: number(found.median_pga_g),
  };
  find("share").textContent = say(found.falls ? "share" : "share_none", values);
  find("sure").textContent = say("sure", values);
  find("share").className = "verdict";
  find("sides").textContent = found.falls ? say("sides", values) : "";
  find("curve-help").textContent = say("curve_help", values);
  const points = found.curve;
  const chart = axes(find("curve"), {
    x: [points[0].scale, points.at(-1).scale], y: [0, 100], logarithmic: true, xText: say("curve_x"),
    yText: say("curve_y"), label: say("curve_title"), format: (value) => number(value),
  });
  chart.band(points.map((p) => [p.scale, 100 * p.low]), points.map((p) => [p.scale, 100 * p.high]));
  chart.line(points.map((p) => [p.scale, 100 * p.share]));
  chart.dots(points.map((p) => [p.scale, 100 * p.share]));
  chart.cursor()(Math.min(Math.max(state.scale, points[0].scale), points.at(-1).scale));
}

async function look() {
  if (state.kind === "uploaded" && !state.uploaded) return;
  let found;
  try {
    found = await ask("motion", { shaking: shakingOf(state), scale: state.scale });
  } catch {
    find("spectrum").replaceChildren();
    return;
  }
  const points = found.period_s.map((period, k) => [period, found.acceleration_g[k]]).filter(([period]) => period >= 0.05);
  const chart = axes(find("spectrum"), {
    x: [0.05, points.at(-1)[0]], y: [0, 1.1 * Math.max(...points.map((p) => p[1]), 1e-6)], logarithmic: true,
    xText: say("period_axis"), yText: "g", label: say("spectrum"), format: (value) => number(value),
  });
  chart.line(points);
}

async function upload(file) {
  const verdict = find("verdict");
  state.uploaded = null;
  if (!file) return;
  try {
    state.uploaded = await read(file, (wait) => { verdict.textContent = say("busy", { wait }); });
    verdict.textContent = say("none");
    changed();
  } catch (error) {
    fail(verdict, error);
  }
}

async function copyLink() {
  keep(state);
  try {
    await navigator.clipboard.writeText(location.href);
    find("linked").textContent = say("copied");
  } catch { // only pages of this machine, or by https, may write there
    find("linked").textContent = location.href;
  }
}

async function dress(wanted) {
  find("language").value = await speak(wanted);
  for (const radio of document.querySelectorAll(".kinds")) radio.setAttribute("aria-label", say("shaking"));
  find("scene").setAttribute("aria-label", say("scene"));
  makeFields();
  listMotions();
  showFilm();
  showShares();
  redraw();
  if (find("look").open) look();
}

find("ask").addEventListener("submit", (event) => { event.preventDefault(); shake(); });
find("hundred").addEventListener("click", askHundred);
find("link").addEventListener("click", copyLink);
find("play").addEventListener("click", () => {
  if (view.time >= lengthOf(view.film)) view.time = startOf(view.film);
  view.playing = !view.playing;
  showMoment();
  run();
});
find("time").addEventListener("input", () => {
  view.playing = false;
  view.time = Number(find("time").value);
  showMoment();
});
find("name").addEventListener("change", () => { state.name = find("name").value; changed(); });
find("reverse").addEventListener("change", () => { state.reverse = find("reverse").checked; changed(); });
find("file").addEventListener("change", () => upload(find("file").files[0]));
find("look").addEventListener("toggle", () => { if (find("look").open) look(); });
find("language").addEventListener("change", () => dress(find("language").value));
find("units").addEventListener("change", () => { units = find("units").value; makeFields(); showFilm(); });
for (const radio of document.querySelectorAll("[name=kind]")) {
  radio.addEventListener("change", () => { state.kind = radio.value; showKind(); changed(); });
}

addEventListener("hashchange", () => location.reload());
find("shake").disabled = true;
await dress(navigator.language.slice(0, 2));
try {
  view.listed = await motions();
  if (!view.listed.some((each) => each.name === state.name)) state.name = view.listed[0].name;
  listMotions();
  find("shake").disabled = false;
} catch (error) {
  fail(find("verdict"), error);
}
