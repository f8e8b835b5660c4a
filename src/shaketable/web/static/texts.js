// Words and numbers of the page, in one language at a time.

let words = {};
let language = "en";

const LANGUAGES = ["en", "es", "de"];

// The language that was chosen last on this machine, or the browser's.
export function preferred() {
  let chosen = null;
  try {
    chosen = localStorage.getItem("language");
  } catch { /* browsers may keep nothing */ }
  return LANGUAGES.includes(chosen) ? chosen : navigator.language.slice(0, 2);
}

export function prefer(wanted) {
  try {
    localStorage.setItem("language", wanted);
  } catch { /* browsers may keep nothing */ }
}

export async function speak(wanted, title = "title") {
  const chosen = LANGUAGES.includes(wanted) ? wanted : "en";
  const found = await (await fetch(`texts/${chosen}.json`)).json();
  [language, words] = [chosen, found];
  document.documentElement.lang = language;
  document.title = `shaketable · ${words[title]}`;
  for (const each of document.querySelectorAll("[data-text]")) each.textContent = words[each.dataset.text];
  for (const each of document.querySelectorAll("[data-help]")) {
    each.replaceChildren(helpOf(each.dataset.help));
  }
  return language;
}

export function say(key, values = {}) {
  return words[key].replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
}

// A number as people of the language write it.
export function number(value, digits = 2) {
  const told = Math.abs(value) < 1e-9 ? 0 : value;
  return new Intl.NumberFormat(language, { maximumSignificantDigits: digits }).format(told);
}

// A number as it stands in a box to write in: without marks between thousands.
export function written(value) {
  return new Intl.NumberFormat(language, { maximumSignificantDigits: 6, useGrouping: false }).format(value);
}

// The number that somebody has written, with a decimal point or comma; NaN if it is none.
export function numberIn(text) {
  return text.trim() === "" ? NaN : Number(text.replace(",", "."));
}

// A time to a hundredth.
export function fixed(value) {
  return new Intl.NumberFormat(language, { minimumFractionDigits: 2, maximumFractionDigits: 2 }).format(value);
}

export function helpOf(key) {
  const details = document.createElement("details");
  const summary = document.createElement("summary");
  summary.textContent = say("more");
  const text = document.createElement("p");
  text.textContent = words[key];
  text.className = "small";
  details.append(summary, text);
  return details;
}
