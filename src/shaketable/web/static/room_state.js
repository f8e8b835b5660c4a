// A room as its file has it: begun, changed and undone, written as TOML, and carried by a link.

import { freePoint, placed } from "./room_geometry.js";

export const SECTIONS = ["door", "place", "thing"];
const MOST_UNDONE = 100;

// Common furniture with usual sizes, assumed: of no source. Lengths in m, masses in kg.
export const CATALOGUE = {
  bookcase: { section: "thing", depth_m: 0.32, width_m: 0.9, height_m: 1.8, mass_kg: 90 },
  wardrobe: { section: "thing", depth_m: 0.58, width_m: 1.0, height_m: 2.1, mass_kg: 95 },
  locker: { section: "thing", depth_m: 0.5, width_m: 0.6, height_m: 1.8, mass_kg: 45 },
  filing: { section: "thing", depth_m: 0.62, width_m: 0.46, height_m: 1.32, mass_kg: 110 },
  cupboard: { section: "thing", depth_m: 0.45, width_m: 1.0, height_m: 1.1, mass_kg: 60 },
  fridge: { section: "thing", depth_m: 0.6, width_m: 0.6, height_m: 1.85, mass_kg: 75 },
  bedside: { section: "thing", depth_m: 0.45, width_m: 0.45, height_m: 0.9, mass_kg: 30, castors: "locked" },
  gas: { section: "thing", diameter_m: 0.23, height_m: 1.46, mass_kg: 65, must_not_fall: "yes" },
  monitor: { section: "thing", depth_m: 0.45, width_m: 0.45, height_m: 1.4, mass_kg: 20, shape: "feet" },
  drip: { section: "thing", depth_m: 0.55, width_m: 0.55, height_m: 1.9, mass_kg: 8, shape: "feet", castors: "free" },
  rack: { section: "thing", depth_m: 0.8, width_m: 0.6, height_m: 2.0, mass_kg: 250 },
  showcase: { section: "thing", depth_m: 0.6, width_m: 0.6, height_m: 1.9, mass_kg: 120 },
  bed: { section: "place", kind: "bed", size_m: [1.0, 2.1], people: 0.9 },
  desk: { section: "place", kind: "desk", size_m: [1.4, 0.7], people: 0.5 },
  turning: { section: "place", kind: "turning", size_m: [1.5, 1.5] },
  corridor: { section: "place", kind: "corridor", size_m: [1.2, 2.0] },
  door: { section: "door", width_m: 0.9, swing: "inward", hinge: "left", exit: true },
};

export function emptyRoom(name) {
  return { name, outline_m: [[0, 0], [5, 0], [5, 4], [0, 4]], way_m: 0.8, door: [], place: [], thing: [] };
}

// The room that is edited, with what it was before each change.
export class Edited {
  constructor(room, changed) {
    this.room = room;
    this.changed = changed;
    [this.before, this.after, this.joined] = [[], [], null];
  }

  // A change; those of one `kind` that follow each other are undone together.
  change(what, kind = null) {
    if (kind === null || kind !== this.joined) this.before.push(JSON.stringify(this.room));
    if (this.before.length > MOST_UNDONE) this.before.shift();
    this.joined = kind;
    this.after = [];
    what(this.room);
    this.changed();
  }

  // What follows is undone by itself.
  rest() {
    this.joined = null;
  }

  replace(room) {
    this.change(() => { this.room = room; });
  }

  undo(from = this.before, to = this.after) {
    if (!from.length) return;
    to.push(JSON.stringify(this.room));
    this.room = JSON.parse(from.pop());
    this.joined = null;
    this.changed();
  }

  redo() {
    this.undo(this.after, this.before);
  }

  list(section) {
    this.room[section] ??= [];
    return this.room[section];
  }

  // A new element of the catalogue at a point, or where there is room; gives its number.
  add(kind, called, point = null) {
    const { section, ...given } = CATALOGUE[kind];
    const element = { name: this.free(called), ...structuredClone(given) };
    this.change((room) => {
      if (section === "door") Object.assign(element, placed(room, section, element, point ?? [room.outline_m[0][0] + 1, room.outline_m[0][1]]));
      else Object.assign(element, placed(room, section, element, point ?? freePoint(room, section, element)));
      this.list(section).push(element);
    });
    return { section, number: this.list(section).length - 1 };
  }

  // A name that nothing has yet.
  free(name) {
    const names = new Set(SECTIONS.flatMap((section) => (this.room[section] ?? []).map((each) => each.name)));
    if (!names.has(name)) return name;
    let k = 2;
    while (names.has(`${name} ${k}`)) k += 1;
    return `${name} ${k}`;
  }
}

function valueOf(value) {
  if (Array.isArray(value)) return `[${value.map(valueOf).join(", ")}]`;
  if (typeof value === "number") return String(Math.round(value * 1e6) / 1e6);
  if (typeof value === "boolean") return String(value);
  return JSON.stringify(String(value));
}

const keyOf = (key) => (/^[\w-]+$/.test(key) ? key : JSON.stringify(key));

function tableOf(table) {
  return Object.entries(table)
    .filter(([, value]) => value !== undefined && value !== null && value !== "")
    .map(([key, value]) => `${keyOf(key)} = ${valueOf(value)}`).join("\n");
}

// The file of a room, as the command line reads it.
export function toml(room) {
  const top = Object.fromEntries(Object.entries(room).filter(([key]) => !SECTIONS.includes(key)));
  const parts = [tableOf(top)];
  for (const section of SECTIONS) for (const each of room[section] ?? []) parts.push(`[[${section}]]\n${tableOf(each)}`);
  return `${parts.join("\n\n")}\n`;
}

const MOST = 100_000; // bytes of a room: no link fills the memory

async function through(stream, bytes) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts = [];
  let count = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    count += part.value.length;
    if (count > MOST) throw new RangeError("too long");
    parts.push(part.value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

// A text in the letters that an address takes.
export async function packed(text) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  const letters = btoa(Array.from(bytes, (each) => String.fromCharCode(each)).join(""));
  return letters.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export async function unpacked(letters) {
  const bytes = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (each) => each.charCodeAt(0));
  return new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes));
}
