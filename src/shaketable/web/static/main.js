// The page of one thing: fields, questions and their answers.

import { ask, motions, read } from "./api.js";
import { axes } from "./chart.js";
import { makeField } from "./fields.js";
import { Player } from "./film.js";
import { failure, find } from "./page.js";
import { many, shareOf, showShares } from "./shares.js";
import { BESIDE, SHAPES, begin, besideOf, changeShape, keep, pathOf, shakingOf, thingOf } from "./state.js";
import { number, prefer, preferred, say, speak } from "./texts.js";
import { sentence } from "./verdict.js";

const state = begin();
// Of each kind of question the latest counts: answers to older ones are dropped.
const latest = { shake: 0, look: 0, upload: 0 };
const view = { film: null, shares: null, asked: "", listed: [], file: null };
let units = "cm";
let player = null;
let live = null; // the question about many shakings that is on its way

const metres = (value) => `${number(value * (units === "cm" ? 100 : 1))} ${units}`;

function makeFields() {
  const field = (name) => makeField(name, state, units, changed);
  const { fields } = SHAPES[state.shape];
  const slides = document.createElement("label");
  const box = Object.assign(document.createElement("input"), { type: "checkbox", id: "slides", checked: state.slides });
  box.addEventListener("change", () => { state.slides = box.checked; showKind(); changed(); });
  slides.append(box, ` ${say("slides")}`);
  find("thing-fields").replaceChildren(...fields.map(field), slides, field("friction"), makeBeside(field));
  find("shaking-fields").replaceChildren(...["period_s", "peak_g", "scale"].map(field));
  showKind();
}

// What stands beside the thing and holds it, each with a box to tick.
function makeBeside(field) {
  const beside = Object.assign(document.createElement("details"), { id: "beside", open: besideOf(state).length > 0 });
  beside.append(Object.assign(document.createElement("summary"), { textContent: say("beside") }));
  for (const [what, names] of Object.entries(BESIDE)) {
    const label = document.createElement("label");
    const box = Object.assign(document.createElement("input"), { type: "checkbox", id: what, checked: state[what] });
    box.addEventListener("change", () => { state[what] = box.checked; showKind(); changed(); });
    label.append(box, ` ${say(what)}`);
    const line = document.createElement("p");
    line.append(label);
    beside.append(line, ...names.map(field));
  }
  return beside;
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
  const beside = besideOf(state);
  for (const name of Object.values(BESIDE).flat()) {
    document.querySelector(`[data-field=${name}]`).hidden = !beside.includes(name);
  }
  const alone = say(beside.length ? "limits_beside" : "limits_alone");
  find("limits-text").textContent = `${say(state.shape === "side" ? "limits_text" : "limits_space")} ${alone}`;
  find("many-help").textContent = say(state.shape === "side" ? "many_help" : "many_space");
  find("reverse").checked = state.reverse;
}

function changed() {
  keep(state);
  if (view.film || view.shaking) drop("changed");
  else player.rest(thingOf(state));
  if (view.asked && askedNow() !== view.asked) later(askMany);
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

// Fetches the recordings to choose from.
async function listMotions() {
  view.listed = await motions();
  if (!view.listed.some((each) => each.name === state.name)) {
    if (state.name) state.unusable = true;
    state.name = view.listed[0].name;
  }
  showMotions();
}

function showMotions() {
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

// What each place says, to say it again in another language or in other units.
const tellings = new Map();

function write(id, words, kind = "") {
  tellings.set(id, words);
  find(id).textContent = words();
  if (id !== "by") find(id).className = `verdict ${kind}`;
}

function fail(id, error) {
  write(id, () => say(...failure(error)));
}

// There is no film any more, nor is one to come; and why.
function drop(key) {
  latest.shake += 1;
  Object.assign(view, { film: null, shaking: false });
  for (const id of ["one-shaking", "by"]) find(id).hidden = true;
  player.rest(thingOf(state));
  write("verdict", () => say(key));
}

async function shake() {
  drop("shaking_now");
  if (!sound("verdict")) return;
  if (state.kind === "uploaded" && !state.uploaded) {
    drop("no_file");
    find("file").focus();
    return;
  }
  const mine = latest.shake;
  const thing = thingOf(state), reverse = state.reverse;
  view.shaking = true;
  try {
    if (state.kind === "recording" && !view.listed.length) await listMotions();
    const waits = (wait) => { if (mine === latest.shake) write("verdict", () => say("busy", { wait })); };
    const film = await ask(pathOf(thing, "simulate"), {
      thing, shaking: shakingOf(state), scale: state.scale, reverse,
    }, { waits });
    if (mine !== latest.shake) return;
    Object.assign(view, { film, shaking: false });
    showVerdict(film, reverse);
    find("result-title").scrollIntoView({ block: "nearest" });
    player.show(film, thing);
  } catch (error) {
    if (mine !== latest.shake) return;
    view.shaking = false;
    fail("verdict", error);
  }
}

// Whether all numbers can be used; if not, a place says which one cannot.
function sound(id) {
  const wrong = document.querySelector(".field.wrong:not([hidden]) input[type=text]");
  if (!wrong) return true;
  const { min, max } = wrong.dataset, field = wrong.labels[0].textContent;
  write(id, () => say("wrong", { field, least: number(min), most: number(max) }));
  wrong.focus();
  return false;
}

function showVerdict(film, reverse) {
  const single = () => (film.components === 1 ? ` ${say("one_component")}` : "");
  const stands = film.moving || film.held_up ? "" : "stands";
  const kind = film.outcome === "standing" ? stands : "falls";
  write("verdict", () => sentence(film, metres) + single(), kind);
  write("by", () => say(reverse ? "by_reversed" : "by", { name: nameOf(film.ground.name) }));
  for (const id of ["one-shaking", "by"]) find(id).hidden = false;
}

const askedNow = () => JSON.stringify([thingOf(state), state.scale]);

async function askMany() {
  live?.abort();
  find("shares").hidden = false;
  find("shares").classList.add("old");
  find("worst").disabled = true;
  view.asked = "nothing that can be asked";
  if (!sound("share")) return;
  live = new AbortController();
  const mine = (view.asked = askedNow());
  const { signal } = live;
  if (!view.shares) write("share", () => say("shaking_now"));
  const { scale } = state, thing = thingOf(state);
  let told = false;
  try {
    const waits = (wait) => { if (!signal.aborted && !told) write("share", () => say("busy", { wait })); };
    for await (const found of many(thing, scale, { signal, waits })) {
      if (mine !== view.asked) return;
      view.shares = found;
      told = true;
      write("share", () => { showShares(found, scale, thing); return shareOf(found); });
      find("shares").classList.remove("old");
      find("worst").disabled = find("worst").hidden = false;
    }
  } catch (error) {
    if (error.name === "AbortError" || mine !== view.asked) return;
    if (told) { // the share stands, and has no curve
      find("curve-help").textContent = say(...failure(error));
      return;
    }
    for (const id of ["sure", "sides", "curve", "curve-help"]) find(id).replaceChildren();
    find("shares").classList.remove("old");
    find("worst").hidden = true;
    view.shares = null;
    fail("share", error);
  }
}

function shakeWorst() {
  const { name, reverse } = view.shares.worst;
  Object.assign(state, { kind: "recording", name, reverse });
  showMotions();
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
  const mine = (latest.upload += 1);
  const chosen = () => mine === latest.upload && state.kind === "uploaded";
  state.uploaded = null;
  find("file-taken").textContent = "";
  if (state.kind === "uploaded") drop("none");
  if (!file) return;
  try {
    const given = {
      units: find("file-units").value,
      time_step_s: find("file-time_step_s").value.replace(",", "."),
      component: find("file-component").value,
    };
    const said = Object.fromEntries(Object.entries(given).filter(([, value]) => value));
    const waits = (wait) => { if (chosen()) write("verdict", () => say("busy", { wait })); };
    const found = await read(file, said, waits);
    if (mine !== latest.upload) return;
    state.uploaded = found;
    find("file-taken").textContent = say("file_taken", { name: found.name });
    if (chosen()) drop("none");
    if (find("look").open) look();
  } catch (error) {
    if (chosen()) fail("verdict", error);
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
  showMotions();
  retell();
  player.dress();
  if (find("look").open) look();
}

function retell() {
  for (const [id, words] of tellings) find(id).textContent = words();
}

find("ask").addEventListener("submit", (event) => { event.preventDefault(); shake(); });
find("many").addEventListener("click", () => {
  askMany();
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
find("units").addEventListener("change", () => { units = find("units").value; makeFields(); retell(); player.redraw(); });
for (const radio of document.querySelectorAll("[name=kind]")) {
  radio.addEventListener("change", () => { state.kind = radio.value; showKind(); changed(); });
}
for (const radio of document.querySelectorAll("[name=shape]")) {
  radio.addEventListener("change", () => {
    changeShape(state, radio.value);
    makeFields();
    changed();
  });
}

addEventListener("hashchange", () => location.reload()); // another link was opened
await speak(preferred());
player = new Player(find("film"), metres);
drop("none");
await dress(preferred());
find("ask").inert = false;
try {
  await listMotions();
  if (state.unusable) write("verdict", () => say("link_unusable"));
} catch (error) {
  fail("verdict", error);
}
