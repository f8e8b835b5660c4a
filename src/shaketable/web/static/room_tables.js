// What was found of a room, in tables.

import { make } from "./page.js";
import { number, say } from "./texts.js";

const share = ({ share: value, low, high }) => `${value} (${low}–${high})`;

function table(title, heads, rows, help = "") {
  const made = make("table");
  const line = (cells, name) => {
    const row = make("tr");
    row.append(...cells.map((each) => make(name, each)));
    return row;
  };
  const [head, body] = [make("thead"), make("tbody")];
  head.append(line(heads.map((each) => say(each)), "th"));
  body.append(...rows.map((cells) => line(cells, "td")));
  made.append(make("caption", say(title)), head, body);
  const wide = make("div", "", { className: "wide", tabIndex: 0, role: "region" });
  wide.setAttribute("aria-label", say(title));
  wide.append(made);
  return help ? [wide, make("p", help, { className: "small" })] : [wide];
}

export function tablesOf(found) {
  const parts = [];
  if (found.changes.length) {
    const rows = [...found.changes.filter((each) => each.saves > 0).slice(0, 12), ...found.pairs.slice(0, 1)];
    parts.push(...table("room_changes", ["room_change", "room_left", "room_saves"],
      rows.map((each) => [each.told, each.left, number(each.saves)]), say(rows.length ? "room_changes_help" : "room_no_change")));
  }
  if (found.ways.length) {
    parts.push(...table("room_ways", ["room_from", "room_to", "room_closed_head", "room_by"],
      found.ways.map((each) => [each.place, each.to, each.open_before ? share(each.closed) + each.at_friction : say("room_narrow"), each.by]), say("room_ways_help")));
  }
  if (found.places.length) {
    parts.push(...table("room_places", ["room_place", "room_hit", "room_by", "room_people_hit"],
      found.places.map((each) => [each.name, share(each.hit) + each.at_friction, each.by, each.people ? number(each.people_hit) : "–"])));
  }
  parts.push(...table("room_things", ["room_thing", "room_falls_head", "room_held_up_head", "room_covers"],
    found.things.map((each) => [each.name, share(each.falls) + each.at_friction, share(each.held_up) + each.held_up_at_friction, number(each.covers_m2)])));
  return parts;
}
