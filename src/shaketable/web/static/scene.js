// The object on its support, seen from the side: one frame of the film at a time.

import { LIES, RATE } from "./times.js";

const RIGHT_ANGLE = Math.PI / 2;

// Where an object is at a time: centre of gravity, rotation, and the ground's displacement.
export function poseAt(film, thing, time) {
  const { rotation_deg, x_m, y_m, ground_m } = film.frames;
  const last = rotation_deg.length - 1;
  const at = Math.min(time * RATE, last);
  const low = Math.floor(at), high = Math.min(low + 1, last), part = at - low;
  const mixed = (series) => series[low] + part * (series[high] - series[low]);
  const pose = {
    x: mixed(x_m), y: mixed(y_m), ground: mixed(ground_m), turn: (mixed(rotation_deg) * Math.PI) / 180,
  };
  if (film.outcome === "standing" || film.off_edge || time * RATE <= last) return pose;
  return fallen(pose, thing, film.outcome === "right" ? 1 : -1, (time - last / RATE) / LIES);
}

// The end of a fall: on about the corner on which it stands, until it lies.
function fallen(pose, thing, side, part) {
  const h = thing.cg_share * thing.height_m;
  const left = thing.eccentricity * thing.base_m;
  const foot = { u: side > 0 ? thing.base_m - left : -left, v: -h };
  const now = turned(foot, pose.turn);
  const corner = { x: pose.x + now.u, y: pose.y + now.v };
  const turn = pose.turn + (side * RIGHT_ANGLE - pose.turn) * Math.min(1, part * part);
  const then = turned(foot, turn);
  return { ...pose, x: corner.x - then.u, y: Math.max(corner.y, 0) - then.v, turn };
}

// A vector of the body after a rotation, clockwise.
function turned({ u, v }, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return { u: u * c + v * s, v: v * c - u * s };
}

const BEHIND = 0.05; // m: where a strap ends that goes to no wall

// How far from its side a strap ends [m].
export function behind(beside) {
  return beside.wall_gap_mm ? beside.wall_gap_mm / 1000 : BEHIND;
}

// Where a strap begins on the body and where it ends, along and normal to the support.
function strapOf(thing, pose) {
  const right = (1 - thing.eccentricity) * thing.base_m;
  const at = turned({ u: right, v: (1 - thing.cg_share) * thing.height_m }, pose.turn);
  return {
    point: { x: pose.x + at.u, y: pose.y + at.v },
    anchor: { x: right + behind(thing.beside), y: thing.height_m },
  };
}

// The force of its strap over its weight at a time.
export function forceAt(film, time) {
  const { strap } = film.frames;
  return strap[Math.min(Math.round(time * RATE), strap.length - 1)] ?? 0;
}

// Where the vertical wall to the right is, from the foot of the centre of gravity.
function wallOf(thing, tilt) {
  const right = (1 - thing.eccentricity) * thing.base_m;
  return right * Math.cos(tilt) + thing.beside.wall_gap_mm / 1000; // its top leans the other way
}

export function draw(canvas, thing, film, time, lengthText) {
  const h = thing.cg_share * thing.height_m, left = thing.eccentricity * thing.base_m;
  const rest = { x: 0, y: h, ground: 0, turn: 0 };
  const pose = film ? poseAt(film, thing, time) : rest;
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(name).trim();
  const context = canvas.getContext("2d");
  const { width, height } = canvas;
  const reach = Math.max(1.25 * Math.hypot(thing.base_m, thing.height_m), 0.2);
  const scale = Math.min((0.82 * height) / reach, (0.45 * width) / reach); // pixels a metre
  const tilt = (thing.tilt_deg * Math.PI) / 180;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, width, height);
  const step = [0.05, 0.1, 0.25, 0.5, 1, 2].find((each) => each * scale > 45) ?? 5;
  const floor = 0.9 * height;
  context.strokeStyle = color("--line");
  context.globalAlpha = 0.25;
  context.lineWidth = 1;
  context.beginPath();
  // seen from the ground, as it moves: the wall behind goes the other way
  const apart = step * scale;
  const first = (((width / 2 - pose.ground * scale) % apart) + apart) % apart;
  for (let x = first; x < width; x += apart) {
    context.moveTo(x, 0);
    context.lineTo(x, height);
  }
  context.stroke();
  context.globalAlpha = 1;
  context.fillStyle = color("--ink");
  context.font = "16px system-ui, sans-serif";
  context.fillText(lengthText(step), 12, 24);
  context.fillRect(12, 32, step * scale, 3);
  context.translate(width / 2, floor);
  context.scale(scale, -scale);
  const beside = thing.beside ?? {};
  context.fillStyle = color("--line");
  if (beside.wall_gap_mm !== undefined) {
    const wall = wallOf(thing, tilt);
    context.fillRect(wall, -0.03 * reach, 0.03 * reach, 1.2 * thing.height_m);
  }
  context.rotate(tilt); // downhill is to the left
  const from = beside.edge_mm === undefined ? -1.1 * reach : -left - beside.edge_mm / 1000;
  context.fillRect(from, -0.03 * reach, 1.1 * reach - from, 0.03 * reach);
  if (beside.lip_mm) context.fillRect(from - 0.01 * reach, -0.03 * reach, 0.01 * reach, beside.lip_mm / 1000 + 0.03 * reach);
  if (beside.strap_slack_mm !== undefined) {
    const { point, anchor } = strapOf(thing, pose);
    const force = film ? forceAt(film, time) : 0;
    context.strokeStyle = color(force > 0 ? "--fall" : "--line");
    context.lineWidth = (force > 0 ? 4 : 2) / scale;
    context.beginPath();
    context.moveTo(point.x, point.y);
    context.lineTo(anchor.x, anchor.y);
    context.stroke();
  }
  context.translate(pose.x, pose.y);
  context.rotate(-pose.turn); // rotations count clockwise
  context.fillStyle = color("--act");
  context.fillRect(-left, -h, thing.base_m, thing.height_m);
  context.strokeStyle = color("--paper");
  context.lineWidth = 2 / scale;
  for (let k = 1; k < 4; k += 1) {
    context.beginPath();
    context.moveTo(-left, -h + (k * thing.height_m) / 4);
    context.lineTo(thing.base_m - left, -h + (k * thing.height_m) / 4);
    context.stroke();
  }
  context.fillStyle = color("--fall");
  context.beginPath();
  context.arc(0, 0, 5 / scale, 0, 2 * Math.PI);
  context.fill();
}
