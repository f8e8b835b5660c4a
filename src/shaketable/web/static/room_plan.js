// The plan of a room as a picture in which things are dragged, turned and chosen.

import { element as made } from "./chart.js";
import { angleOf, at, cornersOf, doorOf, halfOf, placed, toGrid } from "./room_geometry.js";
import { say } from "./texts.js";

const CM = 100; // units of the picture in a metre
const STEP = 0.05, STRIDE = 0.5; // m, by an arrow key, and with the shift key
const SMALLEST = 11; // pixels: of letters
const DRAGS = 4; // pixels: what moves less was pressed
const OUTSIDE = 0.8; // m around the room
export const OPEN = 0.05, CLOSED = 0.2; // of 100 shakings that cannot be excluded: as in the report

const points = (corners) => corners.map(([x, y]) => `${CM * x},${-CM * y}`).join(" ");

export class Plan {
  // In a place of the page; `chosen` is told what is selected.
  constructor(place, edited, chosen) {
    Object.assign(this, { edited, chosen, selected: null, faults: [], found: null });
    this.svg = made("svg", { class: "plan", role: "application" });
    place.replaceChildren(this.svg);
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.target === this.svg || event.target.classList.contains("floor")) this.select(null);
    });
    this.svg.addEventListener("keydown", (event) => this.key(event));
  }

  // Where the pointer is in the plan.
  pointAt(event) {
    const matrix = this.svg.getScreenCTM().inverse();
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    return [x / CM, -y / CM];
  }

  holds(event) {
    const { left, right, top, bottom } = this.svg.getBoundingClientRect();
    return event.clientX >= left && event.clientX <= right && event.clientY >= top && event.clientY <= bottom;
  }

  select(what, focus = false) {
    if (what?.section !== this.selected?.section || what?.number !== this.selected?.number) this.edited.rest();
    if (!what) document.activeElement?.blur?.(); // what had the focus is not chosen again
    this.selected = what;
    this.chosen(what);
    this.draw();
    if (what && focus) this.svg.querySelector("[data-chosen]")?.focus();
  }

  get element() {
    return this.selected && this.edited.room[this.selected.section]?.[this.selected.number];
  }

  // Changes what is selected; `kind` as of `Edited.change`.
  change(values, kind = null) {
    const { section, number } = this.selected;
    this.edited.change((room) => Object.assign(room[section][number], values), kind);
  }

  remove() {
    if (!this.element) return;
    const { section, number } = this.selected;
    const { name } = this.element;
    this.selected = null;
    document.activeElement?.blur?.();
    this.edited.change((room) => {
      room[section].splice(number, 1);
      for (const each of room.thing ?? []) if (each.on === name) delete each.on;
    });
    this.chosen(null);
  }

  turn(degrees) {
    const { section } = this.selected ?? {};
    const key = { thing: "facing_deg", place: "turned_deg" }[section];
    if (!key || !this.element) return;
    const then = (((this.element[key] ?? 0) + degrees) % 360 + 360) % 360;
    this.change({ [key]: then });
  }

  key(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!this.element) return;
    if (way && this.selected.section !== "corner") {
      const step = event.shiftKey ? STRIDE : STEP;
      const point = this.element.at_m.map((each, k) => each + step * way[k]);
      this.change(this.selected.section === "door" ? placed(this.edited.room, "door", this.element, point) : { at_m: at(...point) }, "keys");
    } else if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else if (event.key === "r" || event.key === "R") this.turn(event.shiftKey ? 15 : 90);
    else if (event.key === "Escape") this.select(null);
    else return;
    event.preventDefault();
    this.svg.querySelector("[data-chosen]")?.focus();
  }

  // Drags what is selected, until the pointer is up: by where it was gripped, or what is new by its middle.
  drag(event, target = this.svg) {
    const begin = [event.clientX, event.clientY];
    const grip = this.pointAt(event), from = target === this.svg ? this.element.at_m : grip;
    let moved = false;
    const move = (to) => {
      moved ||= Math.hypot(to.clientX - begin[0], to.clientY - begin[1]) > DRAGS;
      if (!moved || !this.element) return;
      const point = this.pointAt(to).map((each, k) => from[k] + each - grip[k]);
      const { section } = this.selected;
      this.change(placed(this.edited.room, section, this.element, point), "drag");
    };
    const end = () => {
      target.removeEventListener("pointermove", move);
      target.removeEventListener("pointerup", end);
      target.removeEventListener("pointercancel", end);
      this.edited.rest();
    };
    target.setPointerCapture(event.pointerId);
    target.addEventListener("pointermove", move);
    target.addEventListener("pointerup", end);
    target.addEventListener("pointercancel", end);
    event.preventDefault();
  }

  dragCorner(event, number) {
    const move = (to) => {
      const [x, y] = this.pointAt(to);
      this.edited.change((room) => { room.outline_m[number] = at(toGrid(x), toGrid(y)); }, "corner");
    };
    const end = () => {
      this.svg.removeEventListener("pointermove", move);
      this.svg.removeEventListener("pointerup", end);
      this.edited.rest();
    };
    this.svg.setPointerCapture(event.pointerId);
    this.svg.addEventListener("pointermove", move);
    this.svg.addEventListener("pointerup", end);
    event.preventDefault();
  }

  // What was found of things and doors, null where it is of another plan.
  show(found) {
    this.found = found;
    this.heat = found && heatOf(found);
    this.draw();
  }

  draw() {
    const { room } = this.edited;
    const [xs, ys] = [0, 1].map((k) => room.outline_m.map((each) => each[k]));
    const [left, right] = [Math.min(...xs) - OUTSIDE, Math.max(...xs) + OUTSIDE];
    const [low, high] = [Math.min(...ys) - OUTSIDE, Math.max(...ys) + OUTSIDE];
    this.svg.setAttribute("viewBox", `${CM * left} ${-CM * high} ${CM * (right - left)} ${CM * (high - low)}`);
    this.svg.setAttribute("aria-label", say("room_plan"));
    const pixels = this.svg.clientWidth / (CM * (right - left)) || 1; // of one unit: on telephones letters are as large
    this.svg.style.setProperty("--letter", `${Math.max(13, SMALLEST / pixels)}px`);
    const kept = document.activeElement?.dataset?.key;
    const all = (section) => (room[section] ?? []).map((each, number) => this.drawn(section, each, number));
    const parts = [made("polygon", { class: "floor", points: points(room.outline_m) }), ...all("place")];
    if (this.heat) parts.push(this.heat.cloneNode()); // on beds and desks, too
    parts.push(made("polygon", { class: "walls", points: points(room.outline_m) }), ...all("door"), ...all("thing"));
    if (!this.selected) parts.push(...room.outline_m.map((corner, number) => this.handle(corner, number)));
    for (const [k, fault] of this.faults.entries()) {
      const where = fault.at_m ?? room[fault.section]?.[fault.number]?.at_m;
      if (!where) continue;
      const mark = made("g", { class: "fault", transform: `translate(${CM * where[0]} ${-CM * where[1]})` });
      mark.append(made("circle", { r: 14 }), made("text", { y: 5 }, String(k + 1)));
      parts.push(mark);
    }
    if (room.north_deg !== undefined) parts.push(north(room, right - 0.4, high - 0.4));
    this.svg.replaceChildren(...parts);
    spread([...this.svg.querySelectorAll(".part text")]);
    this.drawing = true; // a focus that is given back chooses nothing
    if (kept) this.svg.querySelector(`[data-key="${kept}"]`)?.focus({ preventScroll: true });
    this.drawing = false;
  }

  drawn(section, each, number) {
    const chosen = this.selected?.section === section && this.selected.number === number;
    const group = made("g", {
      class: `part ${section} ${each.kind ?? ""}`, tabindex: 0, role: "button", "data-key": `${section}-${number}`,
      "aria-pressed": chosen,
    });
    if (chosen) group.setAttribute("data-chosen", "");
    const told = [each.name ?? ""];
    if (section === "door") this.drawDoor(group, each, told);
    else {
      const corners = cornersOf(this.edited.room, section, each);
      if (each.diameter_m) group.append(made("circle", { class: "shape", cx: CM * each.at_m[0], cy: -CM * each.at_m[1], r: 50 * each.diameter_m }));
      else group.append(made("polygon", { class: "shape", points: points(corners) }));
      if (section === "thing") this.drawFront(group, each, told);
    }
    group.setAttribute("aria-label", `${say(`room_${section}`)}: ${told.join(" ")}`);
    const text = made("text", { x: CM * each.at_m[0], y: -CM * each.at_m[1] });
    told.forEach((line, k) => text.append(made("tspan", { x: CM * each.at_m[0], dy: k ? "1.1em" : `${-0.55 * (told.length - 1) + 0.35}em` }, `${line} `)));
    group.append(text);
    group.addEventListener("pointerdown", (event) => {
      this.select({ section, number });
      this.svg.querySelector("[data-chosen]")?.focus({ preventScroll: true });
      this.drag(event);
    });
    group.addEventListener("focus", () => { if (!chosen && !this.drawing) this.select({ section, number }, true); });
    return group;
  }

  drawFront(group, thing, told) {
    const angle = angleOf(this.edited.room, thing.facing_deg);
    const [depth] = halfOf(thing);
    const [x, y] = thing.at_m;
    if (!thing.diameter_m) {
      const tip = [x + depth * Math.cos(angle), y + depth * Math.sin(angle)];
      const side = 0.35 * depth;
      const wing = (sense) => [
        tip[0] - side * Math.cos(angle) - sense * side * Math.sin(angle),
        tip[1] - side * Math.sin(angle) + sense * side * Math.cos(angle)];
      group.append(made("polygon", { class: "front", points: points([tip, wing(1), wing(-1)]) }));
    }
    const found = this.found?.things.find((each) => each.name === thing.name);
    if (found) {
      told.push(say("room_falls", { share: found.falls.share }));
      group.setAttribute("data-often", often(found.high));
      group.append(...fallsOf(this.edited.room, thing, found));
    } else if (this.found) {
      told.push(say("room_unknown"));
      group.setAttribute("data-often", "unknown");
    }
  }

  drawDoor(group, door, told) {
    const { hinge, other, sweep } = doorOf(this.edited.room, door);
    group.append(made("polyline", { class: "shape", points: points([hinge, other]) }));
    if (sweep.length) {
      group.append(made("polygon", { class: "sweep", points: points([hinge, ...sweep]) }));
      group.append(made("polyline", { class: "leaf", points: points([hinge, sweep.at(-1)]) }));
    }
    const ways = this.found?.ways.filter((each) => each.door === door.name) ?? [];
    if (!ways.length) return;
    const worst = ways.find((each) => !each.open_before) ?? ways.reduce((one, each) => (each.high > one.high ? each : one));
    told.push(worst.open_before ? say("room_closed", { share: worst.closed.share }) : say("room_narrow"));
    group.setAttribute("data-often", worst.open_before ? often(worst.high) : "often");
  }

  handle([x, y], number) {
    const mark = made("circle", { class: "corner", cx: CM * x, cy: -CM * y, r: 9 });
    mark.addEventListener("pointerdown", (event) => this.dragCorner(event, number));
    return mark;
  }
}

// An arrow out of each side to which a thing falls, as long as that is frequent: as in the report.
function fallsOf(room, thing, found) {
  const front = angleOf(room, thing.facing_deg), [depth, width] = halfOf(thing);
  const ways = [[0, depth], [Math.PI, depth], [-Math.PI / 2, width], [Math.PI / 2, width]]; // its left is to the right of who looks out of its front
  return found.sides.flatMap((share, k) => {
    if (share < 0.005) return [];
    const angle = front + ways[k][0], reach = ways[k][1];
    const out = [Math.cos(angle), Math.sin(angle)];
    const far = 0.15 + 0.85 * share, wide = 0.04 + 0.08 * share;
    const point = (u, v) => [thing.at_m[0] + (reach + u) * out[0] - v * out[1], thing.at_m[1] + (reach + u) * out[1] + v * out[0]];
    const corners = [point(0, wide), point(far - 0.12, wide), point(far - 0.12, 2 * wide), point(far, 0), point(far - 0.12, -2 * wide), point(far - 0.12, -wide), point(0, -wide)];
    return [made("polygon", { class: "fall", points: points(corners) })];
  });
}

function often(high) {
  if (high < OPEN) return "seldom";
  return high < CLOSED ? "some" : "often";
}

function north(room, x, y) {
  const mark = made("g", { class: "north", transform: `translate(${CM * x} ${-CM * y}) rotate(${room.north_deg})` });
  mark.append(made("path", { d: "M0 22V-14M-7 -4L0 -16L7 -4" }), made("text", { y: -22 }, "N"));
  return mark;
}

// Where something lies, in shades of the report's map.
function heatOf(found) {
  const canvas = Object.assign(document.createElement("canvas"), { width: found.columns, height: found.rows });
  const context = canvas.getContext("2d");
  const most = Math.max(0.05, ...found.covered.map(([, share]) => share));
  for (const [cell, share] of found.covered) {
    const part = share / most;
    context.fillStyle = `rgba(${Math.round(254 - 101 * part)}, ${Math.round(196 - 144 * part)}, ${Math.round(79 - 75 * part)}, 0.85)`;
    context.fillRect(cell % found.columns, found.rows - 1 - Math.floor(cell / found.columns), 1, 1);
  }
  const [x, y] = found.low_m;
  const [width, height] = [found.columns, found.rows].map((each) => CM * each * found.cell_m);
  const image = made("image", { x: CM * x, y: -CM * y - height, width, height, preserveAspectRatio: "none", class: "heat" });
  image.setAttribute("href", canvas.toDataURL());
  return image;
}

const TRIES = 8; // lines by which a label is moved down, at most

// Moves labels down that would cover those of their neighbours, the upper ones first.
function spread(labels) {
  const placed = [];
  const boxes = labels.map((label) => ({ label, box: label.getBBox() })).sort((a, b) => a.box.y - b.box.y);
  for (const { label, box } of boxes) {
    if (!box.width) continue;
    const line = box.height / Math.max(label.children.length, 1);
    let down = 0;
    while (down < TRIES * line && placed.some((other) => covers(other, box, down))) down += line / 2;
    if (down) label.setAttribute("transform", `translate(0 ${down})`);
    placed.push({ x: box.x, y: box.y + down, width: box.width, height: box.height });
  }
}

function covers(other, { x, y, width, height }, down) {
  return x < other.x + other.width && other.x < x + width && y + down < other.y + other.height && other.y < y + down + height;
}
