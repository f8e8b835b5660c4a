// The page of a room: its plan is drawn, shaken, and changed.

import { ask, beginRoom, motions, readRoom, result, stop, watch } from "./api.js";
import { Player } from "./film.js";
import { failure, find, make } from "./page.js";
import { showFields } from "./room_fields.js";
import { Plan } from "./room_plan.js";
import { CATALOGUE, Edited, emptyRoom, packed, toml, unpacked } from "./room_state.js";
import { tablesOf } from "./room_tables.js";
import { number, numberIn, prefer, preferred, say, speak, written } from "./texts.js";

const CHECKS = 400; // ms after the last change
const view = { told: null, job: null, found: null, film: null, listed: [], events: null, busy: false };
let plan = null;
let player = null;
let asked = 0; // only the latest answer counts

// What is told is kept as a key, so that it is told again in another language.
function tell(key, values = {}) {
  view.told = [key, values];
  find("told").textContent = key ? say(key, values) : "";
}

const fail = (error) => tell(...failure(error));

const edited = new Edited(emptyRoom("Room"), changed);

function changed() {
  drop("room_changed");
  show();
  later();
}

// What was found and filmed, or is on its way, is of another plan or another question.
function drop(why = "") {
  asked += 1;
  const some = view.found || view.film || view.busy;
  end();
  player?.close();
  player = null;
  if (some && why) tell(why);
  Object.assign(view, { found: null, film: null });
  plan.show(null);
  find("found").hidden = true;
  find("outcomes").replaceChildren();
}

function show() {
  plan.draw();
  showFields(find("fields"), plan);
  find("undo").disabled = !edited.before.length;
  find("redo").disabled = !edited.after.length;
  find("remove").disabled = find("turn").disabled = !plan.element;
  const nothing = !(edited.room.thing ?? []).length;
  for (const id of ["shake", "many", "design", "worst"]) find(id).disabled = nothing || view.busy;
}

let timer = 0;
function later() {
  clearTimeout(timer);
  timer = setTimeout(check, CHECKS);
}

// What is wrong with the plan, as the server reads it.
let checked = 0;
async function check() {
  const mine = (checked += 1);
  try {
    const read = await readRoom("room.toml", toml(edited.room), () => {});
    if (mine === checked) showFaults(read);
  } catch (error) {
    if (mine === checked) showFaults({ faults: [{ text: say(...failure(error)) }], notes: [] });
  }
}

function showFaults({ faults, notes }) {
  plan.faults = faults;
  plan.draw();
  find("faults").replaceChildren(...faults.map((each) => {
    const owner = edited.room[each.section]?.[each.number]?.name;
    return make("li", owner ? `${owner}: ${each.text}` : each.text);
  }));
  find("notes").replaceChildren(...notes.map((each) => make("li", each)));
}

// Begins with a room that a file or a link holds.
async function open(name, data) {
  drop();
  show();
  tell("list_reading");
  try {
    const read = await readRoom(name, data, (wait) => tell("busy", { wait }));
    if (!Array.isArray(read.room.outline_m) || read.faults.some((each) => each.section || !each.at_m && !each.name)) {
      tell("room_unusable");
      find("faults").replaceChildren(...read.faults.map((each) => make("li", each.text)));
      return;
    }
    plan.selected = null;
    edited.replace(read.room);
    showFaults(read);
    tell("");
  } catch (error) {
    fail(error);
  }
}

function question() {
  return { text: toml(edited.room), scale: numberIn(find("scale").value) };
}

// The buttons that compute wait for their answer.
function busy(on) {
  view.busy = on;
  show();
}

function shake() {
  drop();
  return showShaking(question(), { shaking: { kind: "recording", name: find("name").value } });
}

// The worst of many shakings, beside what was found.
function showWorst() {
  const { name, reverse, along_deg, friction } = view.found.worst;
  return showShaking(view.question, { shaking: { kind: "recording", name }, reverse, along_deg, friction });
}

async function showShaking(given, how) {
  const mine = asked;
  busy(true);
  tell("shaking_now");
  try {
    const film = await ask("room/simulate", { ...given, ...how }, { waits: (wait) => tell("busy", { wait }) });
    if (mine !== asked) return;
    view.film = film;
    showFilm();
  } catch (error) {
    if (mine === asked) fail(error);
  } finally {
    busy(false);
  }
}

function showFilm() {
  const { things, left_out } = view.film;
  const falls = things.filter((each) => each.outcome === "falls");
  tell("room_shaken", { falls: falls.length, things: things.length });
  const order = [...things].sort((a, b) => (a.time_s ?? Infinity) - (b.time_s ?? Infinity));
  find("outcomes").replaceChildren(
    ...order.map((each) => make("li", `${each.name}: ${say(`room_${each.outcome}_once`, { time: number(each.time_s ?? 0, 3) })}`)),
    ...left_out.map((name) => make("li", `${name}: ${say("room_unknown")}`)));
  player ??= new Player(find("film"), (value) => `${number(value)} m`);
  player.show(view.film, { room: edited.room });
}

async function many(changes) {
  drop();
  const mine = asked;
  busy(true);
  tell("list_waiting");
  try {
    view.question = question(); // the worst shaking is shown as it was asked for
    const { id } = await beginRoom({ ...view.question, changes });
    if (mine === asked) follow(id, mine);
    else stop(id).catch(() => {});
  } catch (error) {
    if (mine === asked) fail(error);
    busy(false);
  }
}

// Ends the assessment that runs, if one does.
function end() {
  view.events?.close();
  if (!find("running").hidden) stop(view.job).catch(() => {}); // it may have ended by itself
  find("running").hidden = true;
  view.busy = false;
}

function follow(id, mine) {
  view.job = id;
  find("running").hidden = false;
  find("progress").removeAttribute("value");
  view.events = watch(id, async (told) => {
    if (told.state === "running") {
      find("progress").value = Math.min(told.simulations / told.of, 1);
      tell("list_running", { count: number(told.simulations, 3), of: number(told.of, 3) });
    }
    if (!["done", "failed", "stopped"].includes(told.state)) return;
    view.events.close();
    find("running").hidden = true;
    busy(false);
    if (told.state === "failed") tell("failed", { detail: told.detail });
    if (told.state === "stopped") tell("list_stopped");
    if (told.state !== "done") return;
    try {
      const found = await result(id);
      if (mine !== asked) return;
      view.found = found;
      tell("list_done");
      showFound();
    } catch (error) {
      fail(error);
    }
  }, () => { find("running").hidden = true; busy(false); tell("list_gone"); });
}

function showFound() {
  const { found } = view;
  plan.show(found);
  find("found").hidden = false;
  find("summary").replaceChildren(...found.summary.map((each) => make("p", each)));
  find("tables").replaceChildren(...tablesOf(found));
  find("limits").replaceChildren(...found.not_considered.map((each) => make("li", each)));
}

// The catalogue: pressed, a thing is put where there is room; dragged, where it is let go.
function makeCatalogue() {
  const groups = [["room_things_group", "thing"], ["room_places_group", "place"]].map(([title, section]) => {
    const group = make("div");
    group.append(make("strong", say(title)));
    for (const [kind, { section: its }] of Object.entries(CATALOGUE)) {
      if ((its === "thing") !== (section === "thing")) continue;
      const button = make("button", say(`room_new_${kind}`), { type: "button", className: "second" });
      button.dataset.kind = kind;
      button.addEventListener("click", () => {
        if (!button.dragged) plan.select(edited.add(kind, say(`room_new_${kind}`)), true);
        button.dragged = false;
      });
      button.addEventListener("pointerdown", (event) => dragNew(event, button, kind));
      group.append(button);
    }
    return group;
  });
  find("catalogue").replaceChildren(...groups);
}

function dragNew(event, button, kind) {
  button.dragged = false;
  const begin = [event.clientX, event.clientY];
  const move = (to) => {
    if (button.dragged || Math.hypot(to.clientX - begin[0], to.clientY - begin[1]) < 8 || !plan.holds(to)) return;
    button.dragged = true;
    plan.select(edited.add(kind, say(`room_new_${kind}`), plan.pointAt(to)));
    plan.drag(to, button);
  };
  const done = () => {
    button.removeEventListener("pointermove", move);
    button.removeEventListener("pointerup", done);
    button.removeEventListener("pointercancel", done);
  };
  button.setPointerCapture(event.pointerId);
  button.addEventListener("pointermove", move);
  button.addEventListener("pointerup", done);
  button.addEventListener("pointercancel", done);
}

function showMotions() {
  const chosen = find("name").value || "NORTHR/MUL009";
  const groups = new Map();
  for (const each of view.listed) {
    if (!groups.has(each.suite)) groups.set(each.suite, make("optgroup", "", { label: each.suite }));
    const text = `${each.earthquake} · M ${number(each.magnitude)} · ${number(each.peak_g)} g · ${each.name}`;
    groups.get(each.suite).append(new Option(text, each.name, false, each.name === chosen));
  }
  find("name").replaceChildren(...groups.values());
}

async function dress(wanted) {
  find("language").value = await speak(wanted, "room_title");
  makeCatalogue();
  showMotions();
  show();
  check();
  if (view.told) tell(...view.told);
  player?.dress();
  if (view.film) showOutcomesAgain();
  if (!view.found) {
    find("limits").replaceChildren(make("li", say("room_limits")));
    return;
  }
  const mine = asked;
  try {
    const found = await result(view.job);
    if (mine !== asked) return;
    view.found = found;
    showFound();
  } catch (error) {
    if (mine === asked) fail(error);
  }
}

function showOutcomesAgain() {
  const { time, playing } = player;
  showFilm();
  Object.assign(player, { time, playing });
}

find("undo").addEventListener("click", () => { plan.selected = null; edited.undo(); });
find("redo").addEventListener("click", () => { plan.selected = null; edited.redo(); });
find("turn").addEventListener("click", () => plan.turn(90));
find("remove").addEventListener("click", () => plan.remove());
find("shake").addEventListener("click", shake);
find("many").addEventListener("click", () => many(false));
find("worst").addEventListener("click", showWorst);
find("design").addEventListener("click", () => many(true));
find("stop").addEventListener("click", () => stop(view.job).catch(fail));
find("fields").addEventListener("submit", (event) => event.preventDefault());
find("save").addEventListener("click", () => {
  const url = URL.createObjectURL(new Blob([toml(edited.room)], { type: "application/toml" }));
  make("a", "", { href: url, download: "room.toml" }).click();
  URL.revokeObjectURL(url);
});
find("link").addEventListener("click", async () => {
  history.replaceState(null, "", `#${await packed(toml(edited.room))}`);
  try {
    await navigator.clipboard.writeText(location.href);
    find("linked").textContent = say("copied");
  } catch { // the address bar has it
    find("linked").textContent = say("room_linked");
  }
});
find("file").addEventListener("click", () => { find("file").value = ""; });
find("file").addEventListener("change", () => { const file = find("file").files[0]; if (file) open(file.name, file); });
find("language").addEventListener("change", () => { prefer(find("language").value); dress(find("language").value); });
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches("input, select")) return;
  if (event.key === "z" && !event.shiftKey) edited.undo();
  else if (event.key === "y" || (event.key === "z" && event.shiftKey)) edited.redo();
  else return;
  event.preventDefault();
});
for (const kind of ["dragover", "drop"]) {
  document.addEventListener(kind, (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (kind === "drop" && file) open(file.name, file);
  });
}

plan = new Plan(find("plan"), edited, () => show());
find("scale").value = written(1);
await dress(preferred());
edited.room.name = say("room_itself");
try {
  view.listed = await motions();
  showMotions();
} catch (error) {
  fail(error);
}
if (location.hash.length > 1) {
  try {
    await open("room.toml", await unpacked(location.hash.slice(1)));
  } catch {
    tell("room_unusable");
  }
}
