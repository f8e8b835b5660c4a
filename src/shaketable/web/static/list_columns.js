// What each column of a list was taken for, menus to change it, and the file that remembers it.

import { find, make } from "./page.js";
import { say } from "./texts.js";

const SAMPLES = 3; // cells shown of each column
export const SUFFIX = ".columns.toml";

const isUsed = (column) => column.meaning !== "";

// What says what columns mean: TOML, whose texts are written like those of JSON.
export function saidOf(columns) {
  const told = columns.filter((each) => each.header && (isUsed(each) || each.unused));
  const lines = told.map(({ header, meaning, unit }) => {
    const name = meaning && unit ? `${meaning}_${unit}` : meaning;
    return `${JSON.stringify(header)} = ${JSON.stringify(name)}`;
  });
  return lines.length ? `[columns]\n${lines.join("\n")}\n` : "";
}

// Shows the columns of a list; `changed` is called where one of them is to mean something else.
export function showColumns(list, file, changed) {
  const { columns, rows, meanings, sheets, sheet } = list;
  const said = `${sheets.length > 1 ? `sheet = ${JSON.stringify(sheet)}\n\n` : ""}${saidOf(columns.filter((each) => !each.renamed))}`;
  const named = columns.map((column, k) => ({ column, k })).filter(({ column }) => column.header);
  const unused = named.filter(({ column }) => !isUsed(column)).map(({ column }) => column.header);
  const counted = { used: named.length - unused.length, of: named.length, names: unused.join(", ") };
  find("columns-told").textContent = say(unused.length ? "list_columns_unused" : "list_columns_all", counted);
  find("columns").replaceChildren(...named.map(({ column, k }) => {
    const item = make("li");
    const samples = rows.map((row) => row[k] ?? "").filter((text) => text.trim()).slice(0, SAMPLES);
    item.append(make("strong", column.header), menuOf(column, list, changed), make("span", samples.join(" · "), { className: "small" }));
    if (column.asked && !column.unused) {
      item.className = "asked";
      item.append(make("span", say("list_asked"), { className: "small" }));
    }
    return item;
  }));
  const save = find("save-columns");
  URL.revokeObjectURL(save.href);
  save.href = URL.createObjectURL(new Blob([said], { type: "application/toml" }));
  save.download = `${file}${SUFFIX}`;
  save.textContent = say("list_save", { file: save.download });
}

// A menu of what a column may mean, and one of its unit where that has one.
function menuOf(column, { columns, meanings }, changed) {
  const both = make("span");
  const menu = make("select");
  menu.setAttribute("aria-label", say("list_means", { heading: column.header }));
  menu.append(new Option(say("list_unused"), ""), ...meanings.map((each) => new Option(each.label, each.meaning)));
  menu.value = column.meaning;
  menu.addEventListener("change", () => {
    const units = unitsOf(meanings, menu.value);
    // its own unit, which must be known; else that of the other columns, or the first
    const all = column.unit ? [column.unit] : columns.filter(isUsed).map((each) => each.unit);
    const unit = all.find((each) => units.includes(each)) ?? (column.unit ? "" : units[0] ?? "");
    Object.assign(column, { meaning: menu.value, unit, unused: menu.value === "" });
    changed();
  });
  both.append(menu);
  const units = unitsOf(meanings, column.meaning);
  if (units.length) {
    const unit = make("select");
    unit.setAttribute("aria-label", say("list_unit", { heading: column.header }));
    if (!column.unit) unit.append(new Option("?", ""));
    unit.append(...units.map((each) => new Option(each, each)));
    unit.value = column.unit;
    unit.addEventListener("change", () => { column.unit = unit.value; changed(); });
    both.append(unit);
  }
  if (column.asked && !column.unused) {
    const none = make("button", say("list_asked_none"), { type: "button", className: "plain" });
    none.addEventListener("click", () => { column.unused = true; changed(); });
    both.append(none);
  }
  return both;
}

const unitsOf = (meanings, meaning) => meanings.find((each) => each.meaning === meaning)?.units ?? [];

// The sheets of a workbook, of which one is read; `chosen` is called with the name of another.
export function showSheets(sheets, read, chosen) {
  const menu = find("sheet");
  find("sheets").hidden = sheets.length < 2;
  menu.replaceChildren(...(read ? [] : [new Option(say("list_sheet_choose"), "")]), ...sheets.map((each) => new Option(each, each)));
  menu.value = read;
  menu.onchange = () => { if (menu.value) chosen(menu.value); };
}
