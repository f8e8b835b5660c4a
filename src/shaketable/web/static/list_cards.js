// What was found of each object, as cards: in order, filtered, or by the places where things stand.

import { ask } from "./api.js";
import { Player } from "./film.js";
import { failure, find, make } from "./page.js";
import { pathOf } from "./state.js";
import { number, say } from "./texts.js";
import { sentence } from "./verdict.js";

let shown = null; // the player of a card, one at a time
const metres = (value) => `${number(value)} m`;
const riskOf = (risk) => say(`risk_${risk.replaceAll(" ", "_")}`);
const placeOf = ({ building, floor, where }) => [building, floor && say("list_floor", { floor }), where].filter(Boolean).join(" · ");

export class Cards {
  constructor(suite) {
    this.suite = suite;
    this.made = new Map();
  }

  // Cards of the objects that were found, in the order of the menus.
  show(objects) {
    const open = new Set([...document.querySelectorAll(".card[open] strong")].map((each) => each.textContent));
    shown?.close();
    this.made = new Map(objects.map((each) => [each, card(each, this.suite)]));
    for (const [object, each] of this.made) each.open = open.has(object.name);
    const risks = [...new Set(objects.map((each) => each.risk))];
    find("filter").replaceChildren(new Option(say("list_all"), ""), ...risks.map((risk) => new Option(riskOf(risk), risk)));
    this.arrange();
  }

  // The same cards in another order: what is open, and a film that was shown, stays.
  arrange() {
    const by = find("sort").value, only = find("filter").value;
    const some = [...this.made.keys()].filter((each) => !only || each.risk === only);
    if (by === "share") some.sort((a, b) => b.share - a.share);
    if (by === "name") some.sort((a, b) => a.name.localeCompare(b.name));
    const all = by === "place" ? this.byPlace(some) : some.map((each) => this.made.get(each));
    find("cards").replaceChildren(...all);
  }

  // Each place with its cards below it, and how many pieces fall there on average.
  byPlace(objects) {
    const places = Map.groupBy ? Map.groupBy(objects, placeOf) : grouped(objects);
    return [...places].sort(([a], [b]) => a.localeCompare(b)).flatMap(([place, here]) => {
      const pieces = here.reduce((sum, each) => sum + each.quantity, 0);
      const falls = here.reduce((sum, each) => sum + each.share * each.quantity, 0);
      const told = say("list_place", { place: place || say("list_no_place"), falls: number(falls), pieces: number(pieces, 6) });
      return [make("h3", told), ...here.map((each) => this.made.get(each))];
    });
  }
}

function grouped(objects) {
  const places = new Map();
  for (const each of objects) places.set(placeOf(each), [...(places.get(placeOf(each)) ?? []), each]);
  return places;
}

function card(object, suite) {
  const made = make("details", "", { className: "card" });
  made.dataset.risk = object.risk;
  const top = make("summary");
  const share = say(`list_${object.counts}`, {
    share: object.in_100.share, low: object.in_100.low, high: object.in_100.high,
  });
  const where = `${number(object.quantity, 6)} × ${placeOf(object)}`;
  top.append(
    make("strong", object.name), make("span", `${share} · ${object.risk_in_words}`),
    make("span", `${object.measure} · ${where}`),
  );
  made.append(top, ...object.happens.map((each) => make("p", each)));
  const steps = make("ol");
  steps.append(...object.advice.map((each) => make("li", each)));
  made.append(steps);
  made.append(object.thing ? shaking(object.thing, suite) : make("p", say("list_no_film"), { className: "small" }));
  return made;
}

// What shows the object under its worst shaking, and opens it as one thing.
function shaking(thing, suite) {
  const buttons = make("p", "", { className: "buttons" });
  const show = make("button", say("list_play"), { type: "button", className: "second" });
  const verdict = make("p", "", { role: "status" });
  const place = make("div", "", { className: "film" });
  show.addEventListener("click", async () => {
    show.disabled = true;
    verdict.textContent = say("shaking_now");
    try {
      const options = { waits: (wait) => { verdict.textContent = say("busy", { wait }); } };
      const { worst } = await ask(pathOf(thing, "many"), { thing, suite, ...(thing.shape && { curve: false }) }, options);
      const film = await ask(pathOf(thing, "simulate"), {
        thing, shaking: { kind: "recording", name: worst.name }, reverse: worst.reverse,
      }, options);
      verdict.textContent = `${worst.name}: ${sentence(film, metres)}`;
      shown?.close();
      shown = new Player(place, metres);
      shown.show(film, thing);
    } catch (error) {
      verdict.textContent = say(...failure(error));
    } finally {
      show.disabled = false;
    }
  });
  const { friction, ...rest } = thing;
  const known = Object.entries({ shape: "side", ...rest, slides: friction === null ? 0 : 1 }).filter(([, value]) => value !== null);
  buttons.append(show, make("a", say("list_shake"), { href: `.#${new URLSearchParams(known)}` }));
  const all = make("div");
  all.append(buttons, make("p", say("list_squarely"), { className: "small" }), verdict, place);
  return all;
}
