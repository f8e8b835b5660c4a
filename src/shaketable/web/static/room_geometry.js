// The geometry of a plan: x to the right and y up, in metres; directions of things are azimuths.

const DEGREE = Math.PI / 180;
export const GAP = 0.02; // m between a thing and the wall that it is put to
const NEAR = 0.25; // m: what is put down so near to a wall goes to it
const STEP = 0.05; // m of the grid on which things are put down
const BESIDE = 0.05; // m between two things that are placed by themselves

export const toGrid = (value) => Math.round(value / STEP) * STEP;
const rounded = (value) => Math.round(value * 1e4) / 1e4;
export const at = (x, y) => [rounded(x), rounded(y)];

// The direction of an azimuth in the plan, from +x toward +y.
export function angleOf(room, azimuth) {
  return Math.PI / 2 - ((azimuth ?? 0) + (room.north_deg ?? 0)) * DEGREE;
}

function azimuthOf(room, angle) {
  const degrees = 90 - angle / DEGREE - (room.north_deg ?? 0);
  return Math.round((((degrees % 360) + 360) % 360) * 100) / 100;
}

// Half its depth and half its width.
export function halfOf(thing) {
  if (thing.diameter_m) return [thing.diameter_m / 2, thing.diameter_m / 2];
  const depth = thing.depth_m ?? thing.width_m ?? 0.3;
  return [depth / 2, (thing.width_m ?? depth) / 2];
}

function rectangle([x, y], along, half, across) {
  const c = Math.cos(along), s = Math.sin(along);
  return [[half, across], [-half, across], [-half, -across], [half, -across]].map(
    ([u, v]) => [x + u * c - v * s, y + u * s + v * c]);
}

// Corners of what an element of a room stands on.
export function cornersOf(room, section, element) {
  if (section === "place") {
    const [x, y] = element.size_m;
    return rectangle(element.at_m, -(element.turned_deg ?? 0) * DEGREE, x / 2, y / 2);
  }
  const angle = angleOf(room, element.facing_deg);
  const [depth, width] = halfOf(element);
  return rectangle(element.at_m, angle, depth, width);
}

// Its walls: ends, direction along, inward normal and length.
export function wallsOf(room) {
  const corners = room.outline_m;
  const twice = corners.reduce((sum, [x, y], k) => {
    const [u, v] = corners[(k + 1) % corners.length];
    return sum + x * v - u * y;
  }, 0);
  const sense = twice > 0 ? 1 : -1;
  return corners.map((start, k) => {
    const end = corners[(k + 1) % corners.length];
    const length = Math.hypot(end[0] - start[0], end[1] - start[1]) || 1e-9;
    const along = [(end[0] - start[0]) / length, (end[1] - start[1]) / length];
    return { start, end, length, along, inward: [-sense * along[1], sense * along[0]] };
  });
}

// Where a point is from a wall: how far along it, and how far into the room.
function from(wall, [x, y]) {
  const u = x - wall.start[0], v = y - wall.start[1];
  return { along: u * wall.along[0] + v * wall.along[1], off: u * wall.inward[0] + v * wall.inward[1] };
}

function pointAt(wall, along, off) {
  return at(
    wall.start[0] + along * wall.along[0] + off * wall.inward[0],
    wall.start[1] + along * wall.along[1] + off * wall.inward[1]);
}

// The wall that is nearest to a point, among those beside which it is.
function nearest(room, point) {
  let found = null;
  for (const wall of wallsOf(room)) {
    const { along, off } = from(wall, point);
    const outside = Math.max(0, -along, along - wall.length);
    const far = Math.hypot(outside, off);
    if (!found || far < found.far) found = { wall, along, off, far };
  }
  return found;
}

// A thing put down at a point: near a wall its back goes to it.
export function placedThing(room, thing, point) {
  const [depth, width] = halfOf(thing);
  const { wall, along, off } = nearest(room, point);
  if (off - depth > NEAR) return { at_m: at(toGrid(point[0]), toGrid(point[1])) };
  const [least, most] = [width + GAP, wall.length - width - GAP];
  const slid = least <= most ? Math.min(Math.max(toGrid(along), least), most) : wall.length / 2;
  const facing = azimuthOf(room, Math.atan2(wall.inward[1], wall.inward[0]));
  return { at_m: pointAt(wall, slid, depth + GAP), facing_deg: facing };
}

// A place put down at a point: its sides go to the walls that are near.
export function placedPlace(room, place, point) {
  let moved = [toGrid(point[0]), toGrid(point[1])];
  for (const wall of wallsOf(room)) {
    const corners = cornersOf(room, "place", { ...place, at_m: moved });
    const off = Math.min(...corners.map((each) => from(wall, each).off));
    const { along } = from(wall, moved);
    if (Math.abs(off) > NEAR || along < 0 || along > wall.length) continue;
    moved = [moved[0] - off * wall.inward[0], moved[1] - off * wall.inward[1]];
  }
  return { at_m: at(...moved) };
}

// A door is in the wall that is nearest.
export function placedDoor(room, door, point) {
  const { wall, along } = nearest(room, point);
  const half = (door.width_m ?? 0.9) / 2;
  const slid = wall.length > 2 * half ? Math.min(Math.max(toGrid(along), half), wall.length - half) : wall.length / 2;
  return { at_m: pointAt(wall, slid, 0) };
}

export function placed(room, section, element, point) {
  const by = { thing: placedThing, place: placedPlace, door: placedDoor }[section];
  return by(room, element, point);
}

// The ground that a leaf sweeps, and the line of the opening.
export function doorOf(room, door) {
  const { wall } = nearest(room, door.at_m);
  const half = (door.width_m ?? 0.9) / 2;
  const right = [-wall.inward[1], wall.inward[0]]; // of somebody inside who looks at the door
  const side = (door.hinge ?? "left") === "right" ? 1 : -1;
  const [x, y] = door.at_m;
  const hinge = [x + side * right[0] * half, y + side * right[1] * half];
  const other = [x - side * right[0] * half, y - side * right[1] * half];
  const sweep = [];
  const swing = door.swing ?? "inward";
  if (swing !== "sliding") {
    const sense = swing === "inward" ? 1 : -1;
    for (let k = 0; k <= 12; k += 1) {
      const angle = (k / 12) * (Math.PI / 2);
      sweep.push([
        hinge[0] + Math.cos(angle) * (other[0] - hinge[0]) + Math.sin(angle) * 2 * half * sense * wall.inward[0],
        hinge[1] + Math.cos(angle) * (other[1] - hinge[1]) + Math.sin(angle) * 2 * half * sense * wall.inward[1],
      ]);
    }
  }
  return { hinge, other, sweep, inward: wall.inward };
}

// Whether two convex polygons have common ground.
function meet(one, other) {
  for (const [some, all] of [[one, other], [other, one]]) {
    for (let k = 0; k < some.length; k += 1) {
      const [x, y] = some[k], [u, v] = some[(k + 1) % some.length];
      const normal = [v - y, x - u];
      const reach = (points) => points.map((each) => each[0] * normal[0] + each[1] * normal[1]);
      const own = reach(some), its = reach(all);
      if (Math.max(...own) <= Math.min(...its) || Math.max(...its) <= Math.min(...own)) return false;
    }
  }
  return true;
}

function inside(room, [x, y]) {
  let found = false;
  const corners = room.outline_m;
  corners.forEach(([u, v], k) => {
    const [s, t] = corners[(k + 1) % corners.length];
    if ((v > y) !== (t > y) && x < u + ((s - u) * (y - v)) / (t - v)) found = !found;
  });
  return found;
}

// A point where something new has room: along the walls first, then anywhere; the middle if nowhere.
export function freePoint(room, section, element) {
  const taken = ["thing", "place"].flatMap(
    (each) => (room[each] ?? []).filter((one) => one.kind !== "corridor").map((one) => cornersOf(room, each, one)));
  for (const door of room.door ?? []) {
    const { hinge, sweep } = doorOf(room, door);
    if (sweep.length) taken.push([hinge, ...sweep]);
  }
  const [depth, width] = section === "thing" ? halfOf(element) : element.size_m.map((each) => each / 2);
  const tried = [];
  for (const wall of wallsOf(room)) {
    const half = section === "thing" ? width : Math.max(depth, width);
    for (let along = half + BESIDE; along < wall.length - half; along += 0.2) {
      tried.push(pointAt(wall, along, (section === "thing" ? depth : half) + GAP));
    }
  }
  const [xs, ys] = [0, 1].map((k) => room.outline_m.map((each) => each[k]));
  for (let y = Math.min(...ys) + 0.5; y < Math.max(...ys); y += 0.25) {
    for (let x = Math.min(...xs) + 0.5; x < Math.max(...xs); x += 0.25) tried.push([x, y]);
  }
  for (const point of tried) {
    const then = { ...element, ...placed(room, section, element, point) };
    const corners = cornersOf(room, section, then);
    const wide = cornersOf(room, section, section === "thing"
      ? { ...then, depth_m: 2 * (depth + BESIDE), width_m: 2 * (width + BESIDE), diameter_m: undefined }
      : then);
    const within = corners.every(([x, y]) => inside(room, [x + (then.at_m[0] - x) * 0.01, y + (then.at_m[1] - y) * 0.01]));
    if (within && !taken.some((each) => meet(each, wide))) return then.at_m;
  }
  return at((Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2);
}
