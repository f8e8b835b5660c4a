// A list of objects: read, corrected, assessed, and what was found.

import { begin, readHazard, result, stop, understand, watch } from "./api.js";
import { Cards } from "./list_cards.js";
import { SUFFIX, saidOf, showColumns, showSheets } from "./list_columns.js";
import { failure, find, make } from "./page.js";
import { number, numberIn, prefer, preferred, say, speak, written } from "./texts.js";

// `file` is the one that was given: its name, its data, and what it says of its columns.
const view = { list: null, file: null, name: "list.csv", job: null, found: null, events: null, told: null };
const SUITE = "fema-p695-both-directions"; // by which lists are shaken
const cards = new Cards(SUITE);
const EXAMPLE = "name,quantity,location,depth_m,width_m,height_m\nBookcase,8,corridor,0.32,0.9,1.8\nCabinet,3,office,0.45,0.9,1.1\n";

// What is told is kept as a key, so that it is told again in another language.
function tell(key, values = {}) {
  view.told = [key, values];
  find("told").textContent = key ? say(key, values) : "";
}

function fail(error) {
  tell(...failure(error));
}

// Ends the assessment that runs, if one does.
function end() {
  view.events?.close();
  if (!find("running").hidden) stop(view.job).catch(() => {}); // it may have ended by itself
  find("running").hidden = true;
}

// Buttons that ask for something wait for its answer, and only the latest answer counts.
let asked = 0;
function asking(on) {
  for (const id of ["again", "run", "empty"]) find(id).disabled = on;
  if (!on) find("run").disabled = !view.list || view.list.faults.length > 0;
}

// Reads a list; if it cannot be read, the one that `kept` is, with its cells, stays.
async function take(name, data, { kept = null, sheet = "", columns = "", rows = "" } = {}) {
  await dressed; // words may still be on their way
  const mine = (asked += 1);
  end();
  history.replaceState(null, "", location.pathname);
  Object.assign(view, { list: null, found: null, job: null });
  for (const id of ["found", "running", "understood"]) find(id).hidden = true;
  for (const id of ["faults", "notes"]) find(id).replaceChildren();
  if (!kept) find("sheets").hidden = true;
  tell("list_reading");
  asking(true);
  try {
    const list = await understood(name, data, { sheet, columns, rows });
    if (mine !== asked) return;
    if (kept) carry(kept, list);
    Object.assign(view, { list, name });
    showList();
  } catch (error) {
    if (mine !== asked) return;
    view.list = kept;
    find("understood").hidden = !kept;
    fail(error);
  } finally {
    if (mine === asked) asking(false);
  }
}

function understood(name, data, options) {
  const given = { sizes: find("sizes").checked, catalogue: find("catalogue").checked, ...options };
  return understand(name, data, given, (wait) => tell("busy", { wait }));
}

// What the list that was given said and the cells of the page do not: sheets, units beside names.
function carry(before, list) {
  const { sheets, sheet, builtAs, leftOut } = before;
  Object.assign(list, { sheets, sheet, building: before.building, builtAs, leftOut });
  putBack(before, list);
  list.columns.forEach((column, k) => { if (!column.meaning) column.unit = before.columns[k]?.unit ?? ""; });
}

// Rows that were left out on the page, at their places among those that were read again.
function putBack(before, list) {
  for (const number of before.leftOut ?? []) {
    const k = before.numbers.indexOf(number);
    if (k < 0 || list.numbers.includes(number)) continue;
    const at = list.numbers.filter((each) => each < number).length;
    list.numbers.splice(at, 0, number);
    list.rows.splice(at, 0, before.rows[k]);
  }
}

// The list as it stands in the page, read again.
function again() {
  take(view.name, csv(), { kept: view.list, columns: saidOf(view.list.columns), rows: rowsOf(view.list) });
}

// Reads files that were given: a list, and the file that says what its columns mean.
async function takeFiles(files) {
  const all = [...files];
  const said = all.find((each) => each.name.endsWith(SUFFIX));
  const list = all.find((each) => each !== said);
  if (!list) return;
  view.file = { name: list.name, data: list, columns: said ? await said.text() : "" };
  takeSheet();
}

function takeSheet(sheet = "") {
  const { name, data, columns } = view.file;
  take(name, data, { sheet, columns });
}

function showList() {
  const { columns, rows, numbers, objects, faults, notes, sheets, sheet } = view.list;
  showSheets(sheets, sheet, takeSheet);
  const which = !columns.length && sheets.length;
  tell(which ? "list_which" : faults.length ? "list_faults" : "list_read", { objects: number(objects, 5) });
  find("faults").replaceChildren(...faults.map((fault) => make("li", fault)));
  find("notes").replaceChildren(...notes.map((note) => make("li", note)));
  if (which) return;
  showBuilding();
  showColumns(view.list, view.file?.name ?? view.name, again);
  const head = make("tr");
  head.append(make("td"));
  for (const column of columns) {
    const { header } = column;
    const cell = make("th", "", { scope: "col" });
    const box = make("input", "", { value: header, maxLength: 500 });
    box.setAttribute("aria-label", say("list_heading", { heading: header }));
    // another heading is read anew: what the one before meant is forgotten
    box.addEventListener("input", () => Object.assign(column, { header: box.value, meaning: "", unused: false, edited: true }));
    cell.append(box);
    head.append(cell);
  }
  const body = make("tbody");
  rows.forEach((row, k) => {
    const line = make("tr");
    const leave = make("input", "", { type: "checkbox", checked: !isLeftOut(numbers[k]) });
    leave.setAttribute("aria-label", say("list_row_kept", { row: number(numbers[k], 7) }));
    leave.addEventListener("change", () => { leaveOut(numbers[k], !leave.checked); line.classList.toggle("left", !leave.checked); });
    line.classList.toggle("left", isLeftOut(numbers[k]));
    const first = make("th", "", { scope: "row" });
    const label = make("label");
    label.append(leave, ` ${number(numbers[k], 7)}`);
    first.append(label);
    line.append(first);
    columns.forEach(({ header }, j) => {
      const cell = make("td");
      const box = make("input", "", { value: row[j] ?? "", maxLength: 500 });
      box.setAttribute("aria-label", `${header}, ${numbers[k]}`);
      box.addEventListener("input", () => { row[j] = box.value; });
      cell.append(box);
      line.append(cell);
    });
    body.append(line);
  });
  const top = make("thead");
  top.append(head);
  find("cells").replaceChildren(top, body);
  find("understood").hidden = false;
}

const STOREY_HEIGHT = 3.2; // m
const STRUCTURES = ["concrete frame", "steel frame", "braced steel frame", "concrete walls", "masonry", "timber"];

// The building: what a sheet of the workbook says of it, until somebody chooses.
function showBuilding() {
  const { building, floors } = view.list;
  if (!view.list.builtAs) {
    find("structure").value = building?.structure ?? "";
    find("storeys").value = building?.storeys ?? 3;
    find("storey-height").value = written(building?.storey_height_m ?? STOREY_HEIGHT);
    view.list.builtAs = true;
  }
  for (const id of ["storeys", "storey-height"]) find(id).disabled = !find("structure").value;
  find("floors-unused").hidden = !floors || Boolean(find("structure").value);
}

function nameStructures() {
  const chosen = find("structure").value;
  find("structure").replaceChildren(
    new Option(say("list_structure_none"), ""),
    ...STRUCTURES.map((each) => new Option(say(`structure_${each.replaceAll(" ", "_")}`), each)),
  );
  find("structure").value = chosen;
}

// The levels of the ground's shaking, named by how seldom the curve of a site says they come.
function showLevels() {
  const { level } = view, menu = find("level");
  menu.replaceChildren(new Option(say("list_as_recorded"), ""), ...(view.site?.levels ?? []).map((each, k) => new Option(
    say("list_level", { years: number(each.years, 4), level: each.in_words, site: view.site.name }), String(k),
  )));
  menu.value = level ?? "";
}

async function takeHazard(file) {
  if (!file) return;
  try {
    const { levels } = await readHazard(file, (wait) => tell("busy", { wait }));
    Object.assign(view, { site: { name: file.name, levels }, level: "1" });
    showLevels();
    tell("list_level_read");
  } catch (error) {
    fail(error);
  }
}

function level() {
  const chosen = view.site?.levels[find("level").value];
  return chosen ? { measure: chosen.measure, value: chosen.value, said: find("level").selectedOptions[0].text } : null;
}

// The factor on the strength; a level of the site takes its place.
function strength() {
  const value = numberIn(find("scale").value);
  return level() || !(value > 0) ? 1 : value;
}

function building() {
  const structure = find("structure").value;
  if (!structure) return null;
  return { structure, storeys: Number(find("storeys").value), storey_height_m: numberIn(find("storey-height").value) };
}

const isLeftOut = (number) => view.list.leftOut?.includes(number) ?? false;

// Leaves a row out of what is assessed, or takes it back; its number is that of the user's file.
function leaveOut(number, left) {
  const others = (view.list.leftOut ?? []).filter((each) => each !== number);
  view.list.leftOut = left ? [...others, number] : others;
}

// The list as it stands in the page, for the server.
function csv() {
  const quoted = (text) => `"${String(text ?? "").replaceAll('"', '""').replace(/[\r\n]+/g, " ")}"`;
  const { columns, rows, numbers } = view.list;
  const line = (cells) => cells.map(quoted).join(",");
  const kept = rows.filter((_, k) => !isLeftOut(numbers[k]));
  return `${[line(columns.map(headingOf)), ...kept.map(line)].join("\n")}\n`;
}

// The numbers of its rows in the user's file, as "3-9,11", by which messages name them.
function rowsOf({ numbers }) {
  const spans = [];
  for (const each of numbers.filter((number) => !isLeftOut(number))) {
    const last = spans.at(-1);
    if (last && each === last[1] + 1) last[1] = each;
    else spans.push([each, each]);
  }
  return spans.map(([one, other]) => (one === other ? `${one}` : `${one}-${other}`)).join(",");
}

// A heading that was corrected keeps the unit that stood elsewhere, unless it says one itself.
function headingOf({ header, edited, unit }) {
  const says = /[)\]]\s*$|[_\s](m|cm|mm|in|ft|kg|g|t|lb|lbs|n|kn)$/i.test(header.trim());
  return edited && unit && header.trim() && !says ? `${header} (${unit})` : header;
}

async function run() {
  const text = csv(), columns = saidOf(view.list.columns), rows = rowsOf(view.list);
  const mine = (asked += 1);
  end();
  asking(true);
  try {
    const checked = await understood(view.name, text, { columns, rows });
    if (mine !== asked) return;
    if (checked.faults.length) {
      view.list.faults = checked.faults;
      showList();
      return;
    }
    const { id } = await begin({
      name: view.name.slice(-100), text, columns, rows, suite: SUITE, planar: find("planar").checked, accept_sizes: find("sizes").checked,
      catalogue: find("catalogue").checked, building: building(), level: level(), scale: strength(),
      wall: find("wall").value,
    });
    if (mine === asked) follow(id);
    else stop(id).catch(() => {});
  } catch (error) {
    if (mine === asked) fail(error);
  } finally {
    if (mine === asked) asking(false);
  }
}

function follow(id) {
  Object.assign(view, { job: id, found: null });
  history.replaceState(null, "", `#${id}`);
  find("running").hidden = false;
  find("found").hidden = true;
  find("progress").removeAttribute("value");
  tell("list_waiting");
  view.events?.close();
  view.events = watch(id, async (told) => {
    if (told.state === "running") {
      find("progress").value = Math.min(told.simulations / told.of, 1);
      tell("list_running", { count: number(told.simulations, 3), of: number(told.of, 3) });
    }
    if (!["done", "failed", "stopped"].includes(told.state)) return;
    view.events.close();
    find("running").hidden = true;
    if (told.state === "failed") tell("failed", { detail: told.detail });
    if (told.state === "stopped") tell("list_stopped");
    if (told.state !== "done") return;
    try {
      const found = await result(id);
      if (view.job !== id) return;
      view.found = found;
      tell("list_done");
      showFound();
      find("found").scrollIntoView();
    } catch (error) {
      fail(error);
    }
  }, () => { find("running").hidden = true; tell("list_gone"); });
}

function showFound() {
  const { headline, how_sure, notes, objects } = view.found;
  find("found").hidden = false;
  find("headline").replaceChildren(...headline.map((each) => make("p", each)));
  find("sure").replaceChildren(...how_sure.map((each) => make("p", each, { className: "small" })));
  find("warnings").replaceChildren(...notes.map((each) => make("li", each)));
  const { lang } = document.documentElement;
  find("report").href = `api/assess/${view.job}/${lang === "en" ? "report.html" : `report.${lang}.html`}`;
  find("remarks").href = `api/assess/${view.job}/${say("list_remarks_file")}`;
  find("csv").href = `api/assess/${view.job}/results.csv`;
  cards.show(objects);
}

async function dress(wanted) {
  find("language").value = await speak(wanted, "list_title");
  nameStructures();
  showLevels();
  await retell();
}

// What the server told, told again in the language that was chosen.
async function retell() {
  const last = view.told, mine = asked, wanted = document.documentElement.lang;
  if (last) tell(...last);
  try {
    const { columns } = view.list ?? {};
    const list = columns?.length
      ? await understood(view.name, csv(), { columns: saidOf(columns), rows: rowsOf(view.list) })
      : view.list && await understood(view.file.name, view.file.data, {});
    const found = view.found && await result(view.job);
    if (mine !== asked || wanted !== document.documentElement.lang) return;
    if (list) {
      carry(view.list, list);
      Object.assign(view.list, list);
      showList();
    }
    if (found && view.found) {
      view.found = found;
      showFound();
    }
    if (last) tell(...last);
  } catch (error) {
    fail(error);
  }
}

// A list that was mended can be chosen again: browsers tell only of another one.
find("file").addEventListener("click", () => { find("file").value = ""; });
find("file").addEventListener("change", () => { takeFiles(find("file").files); });
find("empty").addEventListener("click", () => {
  view.file = { name: "example.csv", data: EXAMPLE, columns: "" };
  takeSheet();
});
find("again").addEventListener("click", again);
find("structure").addEventListener("change", showBuilding);
find("level").addEventListener("change", () => { view.level = find("level").value; });
find("hazard").addEventListener("change", () => takeHazard(find("hazard").files[0]));
for (const id of ["sizes", "catalogue"]) find(id).addEventListener("change", () => { if (view.list?.columns.length) again(); });
find("run").addEventListener("click", run);
find("stop").addEventListener("click", () => stop(view.job).catch(fail));
addEventListener("hashchange", () => location.reload()); // the address of another result
for (const id of ["sort", "filter"]) find(id).addEventListener("change", () => cards.arrange());
find("language").addEventListener("change", () => { prefer(find("language").value); dress(find("language").value); });
let folded = []; // cards that are opened for the printer
addEventListener("beforeprint", () => {
  folded = [...document.querySelectorAll(".card:not([open])")];
  for (const each of folded) each.open = true;
});
addEventListener("afterprint", () => { for (const each of folded) each.open = false; });
for (const kind of ["dragover", "drop"]) {
  document.addEventListener(kind, (event) => {
    event.preventDefault();
    if (kind === "drop" && event.dataTransfer) takeFiles(event.dataTransfer.files);
  });
}

const dressed = dress(preferred());
await dressed;
const kept = location.hash.slice(1);
if (/^[\w-]{10,40}$/.test(kept)) follow(kept);
