// The page of one thing: fields, questions and their answers.

import { ask, motions, read } from "./api.js";
import { axes } from "./chart.js";
import { makeField } from "./fields.js";
import { Player } from "./film.js";
import { find, told } from "./page.js";
import { hundred, showShares } from "./shares.js";
import { SHAPES, begin, keep, pathOf, shakingOf, thingOf } from "./state.js";
import { number, prefer, preferred, say, speak } from "./texts.js";
import { sentence } from "./verdict.js";

const state = begin();
// Of each kind of question the latest counts: answers to older ones are dropped.
const latest = { shake: 0, look: 0, upload: 0 };
const view = { film: null, shares: null, asked: "", listed: [], file: null };
let units = "cm";
let player = null;
let live = null; // the question about 100 shakings that is on its way

const metres = (value) => `${number(value * (units === "cm" ? 100 : 1))} ${units}`;

function makeFields() {
  const field = (name) => makeField(name, state, units, changed);
  const { fields } = SHAPES[state.shape];
  const slides = document.createElement("label");
  const box = Object.assign(document.createElement("input"), { type: "checkbox", id: "slides", checked: state.slides });
  box.addEventListener("change", () => { state.slides = box.checked; showKind(); changed(); });
  slides.append(box, ` ${say("slides")}`);
  const strap = fields.includes("strap_n_kg") ? [field("strap_n_kg")] : [];
  find("thing-fields").replaceChildren(
    ...fields.filter((name) => name !== "strap_n_kg").map(field), slides, field("friction"), ...strap,
  );
  find("shaking-fields").replaceChildren(...["period_s", "peak_g", "scale"].map(field));
  showKind();
}

function showKind() {
  for (const radio of document.querySelectorAll("[name=shape]")) radio.checked = radio.value === state.shape;
  for (const radio of document.querySelectorAll("[name=kind]")) radio.checked = radio.value === state.kind;
  for (const each of document.querySelectorAll("[data-kind]")) each.hidden = each.dataset.kind !== state.kind;
  for (const name of ["period_s", "peak_g"]) {
    document.querySelector(`[data-field=${name}]`).hidden = state.kind !== "pulse";
  }
  document.querySelector("[data-field=friction]").hidden = !state.slides;
  find("no-sliding").hidden = state.slides;
  find("limits-text").textContent = say(state.shape === "side" ? "limits_text" : "limits_space");
  find("hundred-help").textContent = say(state.shape === "side" ? "hundred_help" : "hundred_space");
  find("reverse").checked = state.reverse;
}

function changed() {
  keep(state);
  latest.shake += 1;
  if (view.film || view.shaking) {
    Object.assign(view, { film: null, shaking: false });
    showVerdict("changed");
  }
  player.rest(thingOf(state));
  if (view.asked && askedNow() !== view.asked) later(askHundred);
  if (find("look").open) later(look);
}

// Asks once the sliders have come to rest.
const timers = new Map();
function later(what) {
  clearTimeout(timers.get(what));
  timers.set(what, setTimeout(what, 200));
}

// A motion in words: its earthquake, if it is a recorded one.
function nameOf(name) {
  const known = view.listed.find((each) => each.name === name);
  return known ? `${known.earthquake} (${name})` : name;
}

function listMotions() {
  const select = find("name");
  select.replaceChildren();
  const groups = new Map();
  for (const each of view.listed) {
    if (!groups.has(each.suite)) groups.set(each.suite, Object.assign(document.createElement("optgroup"), { label: each.suite }));
    const far = `M ${number(each.magnitude)}, ${number(each.distance_km, 2)} km`;
    const text = `${each.earthquake} · ${far} · ${number(each.peak_g)} g · ${number(each.duration_s)} s · ${each.name}`;
    groups.get(each.suite).append(new Option(text, each.name, false, each.name === state.name));
  }
  select.append(...groups.values());
}

function fail(place, error) {
  place.className = "verdict";
  place.textContent = told(error);
}

async function shake() {
  const verdict = find("verdict");
  if (!sound(verdict)) return;
  if (state.kind === "uploaded" && !state.uploaded) {
    showVerdict("no_file");
    find("file").focus();
    return;
  }
  const mine = (latest.shake += 1);
  const thing = thingOf(state);
  view.shaking = true;
  verdict.className = "verdict";
  verdict.textContent = say("shaking_now");
  try {
    const waits = (wait) => { verdict.textContent = say("busy", { wait }); };
    const film = await ask(pathOf(thing, "simulate"), {
      thing, shaking: shakingOf(state), scale: state.scale, reverse: state.reverse,
    }, { waits });
    if (mine !== latest.shake) return;
    Object.assign(view, { film, shaking: false });
    showVerdict();
    find("result-title").scrollIntoView({ block: "nearest" });
    player.show(film, thing);
  } catch (error) {
    if (mine !== latest.shake) return;
    view.shaking = false;
    fail(verdict, error);
  }
}

// Whether all numbers can be used; if not, says which one cannot.
function sound(place) {
  const wrong = document.querySelector(".field.wrong:not([hidden]) input[type=number]");
  if (!wrong) return true;
  const values = { field: wrong.labels[0].textContent, least: number(wrong.min), most: number(wrong.max) };
  place.className = "verdict";
  place.textContent = say("wrong", values);
  wrong.focus();
  return false;
}

function showVerdict(otherwise = "none") {
  const { film } = view;
  for (const id of ["one-shaking", "by"]) find(id).hidden = !film;
  if (!film) {
    find("verdict").className = "verdict";
    find("verdict").textContent = say(otherwise);
    return;
  }
  find("verdict").className = `verdict ${film.outcome === "standing" ? "stands" : "falls"}`;
  const single = film.components === 1 ? ` ${say("one_component")}` : "";
  find("verdict").textContent = `${sentence(film, metres)}${single}`;
  find("by").textContent = say(state.reverse ? "by_reversed" : "by", { name: nameOf(film.ground.name) });
}

const askedNow = () => JSON.stringify([thingOf(state), state.scale, state.strap_n_kg]);

async function askHundred() {
  live?.abort();
  find("shares").hidden = false;
  find("shares").classList.add("old");
  if (!sound(find("share"))) return;
  live = new AbortController();
  view.asked = askedNow();
  const { signal } = live;
  if (!view.shares) find("share").textContent = say("shaking_now");
  try {
    const waits = (wait) => { find("share").textContent = say("busy", { wait }); };
    for await (const found of hundred(thingOf(state), state.scale, state.strap_n_kg, { signal, waits })) {
      view.shares = found;
      showShares(found, state.scale, state.strap_n_kg);
      find("shares").classList.remove("old");
      find("worst").hidden = false;
    }
  } catch (error) {
    if (error.name === "AbortError") return;
    for (const id of ["sure", "sides", "curve", "curve-help"]) find(id).replaceChildren();
    find("shares").classList.remove("old");
    find("worst").hidden = true;
    view.shares = null;
    fail(find("share"), error);
  }
}

function shakeWorst() {
  if (askedNow() !== view.asked) return; // the one of this thing is on its way
  const { name, reverse } = view.shares.worst;
  Object.assign(state, { kind: "recording", name, reverse });
  listMotions();
  showKind();
  changed();
  shake();
}

async function look() {
  if (state.kind === "uploaded" && !state.uploaded) return;
  const mine = (latest.look += 1);
  let found;
  try {
    found = await ask("motion", { shaking: shakingOf(state), scale: state.scale });
  } catch {
    if (mine === latest.look) for (const id of ["preview", "spectrum"]) find(id).replaceChildren();
    return;
  }
  if (mine !== latest.look) return;
  const { acceleration_g, time_step_s, peak_g, name } = found.ground;
  const trace = axes(find("preview"), {
    x: [0, (acceleration_g.length - 1) * time_step_s], y: [-peak_g || -1, peak_g || 1], yText: "g",
    xText: `${say("time")} [${say("seconds")}]`, label: `${say("trace")}: ${name}`, format: (value) => number(value),
  });
  trace.line(acceleration_g.map((a, k) => [k * time_step_s, a]));
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
  const mine = (latest.upload += 1);
  find("file-taken").textContent = "";
  try {
    const given = ["units", "time_step_s", "component"].map((name) => [name, find(`file-${name}`).value]);
    const said = Object.fromEntries(given.filter(([, value]) => value));
    const found = await read(file, said, (wait) => { verdict.textContent = say("busy", { wait }); });
    if (mine !== latest.upload) return;
    state.uploaded = found;
    find("file-taken").textContent = say("file_taken", { name: found.name });
    changed();
    showVerdict();
  } catch (error) {
    if (mine === latest.upload) fail(verdict, error);
  }
}

async function copyLink() {
  keep(state);
  try {
    await navigator.clipboard.writeText(location.href);
    find("linked").textContent = say(state.kind === "uploaded" ? "copied_bare" : "copied");
  } catch { // only pages of this machine, or by https, may write there
    find("linked").textContent = location.href;
  }
}

async function dress(wanted) {
  find("language").value = await speak(wanted);
  for (const radios of document.querySelectorAll(".kinds")) radios.setAttribute("aria-label", say(radios.dataset.label));
  makeFields();
  listMotions();
  showVerdict();
  if (view.shares) showShares(view.shares, state.scale, state.strap_n_kg);
  if (player) player.dress();
  else {
    player = new Player(find("film"), metres);
    player.rest(thingOf(state));
  }
  if (find("look").open) look();
}

find("ask").addEventListener("submit", (event) => { event.preventDefault(); shake(); });
find("hundred").addEventListener("click", () => {
  askHundred();
  find("share-title").scrollIntoView({ block: "nearest" });
});
find("worst").addEventListener("click", shakeWorst);
find("link").addEventListener("click", copyLink);
find("name").addEventListener("change", () => { state.name = find("name").value; changed(); });
find("reverse").addEventListener("change", () => { state.reverse = find("reverse").checked; changed(); });
// A file that was mended can be chosen again: browsers tell only of another one.
find("file").addEventListener("click", () => { find("file").value = ""; });
find("file").addEventListener("change", () => { view.file = find("file").files[0]; upload(view.file); });
for (const name of ["units", "time_step_s", "component"]) {
  find(`file-${name}`).addEventListener("change", () => upload(view.file));
}
find("look").addEventListener("toggle", () => { if (find("look").open) look(); });
find("language").addEventListener("change", () => { prefer(find("language").value); dress(find("language").value); });
find("units").addEventListener("change", () => { units = find("units").value; makeFields(); showVerdict(); player.redraw(); });
for (const radio of document.querySelectorAll("[name=kind]")) {
  radio.addEventListener("change", () => { state.kind = radio.value; showKind(); changed(); });
}
for (const radio of document.querySelectorAll("[name=shape]")) {
  radio.addEventListener("change", () => {
    state.shape = radio.value;
    makeFields();
    changed();
  });
}

addEventListener("hashchange", () => location.reload()); // another link was opened
find("shake").disabled = true;
await dress(preferred());
try {
  view.listed = await motions();
  if (!view.listed.some((each) => each.name === state.name)) {
    state.unusable ||= state.name !== "";
    state.name = view.listed[0].name;
  }
  if (state.unusable) find("verdict").textContent = say("link_unusable");
  listMotions();
  find("shake").disabled = false;
} catch (error) {
  fail(find("verdict"), error);
}
