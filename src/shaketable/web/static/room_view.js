// A room in three dimensions: one frame of the film at a time. x to the right, y to the back, z up.

import * as three from "./vendor/three.module.min.js";
import { cornersOf, wallsOf } from "./room_geometry.js";
import { View } from "./solid.js";
import { rateOf } from "./times.js";

const SIDES = 32;
const HIGH = 2.4; // m: of the walls, assumed
const PLACE = 0.5; // m: of a bed or desk, assumed

// Where a thing is at a time, in the plan.
export function poseAt(film, frames, time) {
  const { quaternion, position_m } = frames;
  const last = quaternion.length - 1;
  const now = Math.min(time * rateOf(film), last);
  const low = Math.floor(now), high = Math.min(low + 1, last), part = now - low;
  const position = position_m[low].map((value, k) => value + part * (position_m[high][k] - value));
  const turn = new three.Quaternion(...quaternion[low]).slerp(new three.Quaternion(...quaternion[high]), part);
  return { position, turn };
}

export class RoomView extends View {
  build({ room }, film) {
    this.clear();
    const style = getComputedStyle(document.documentElement);
    const color = (name) => new three.Color(style.getPropertyValue(name).trim());
    const corners = room.outline_m;
    const [xs, ys] = [0, 1].map((k) => corners.map((each) => each[k]));
    const middle = [(Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2];
    const size = Math.hypot(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
    this.scene = new three.Scene();
    this.scene.background = color("--soft");
    this.scene.add(new three.HemisphereLight(0xffffff, 0x888888, 1.8));
    const light = new three.DirectionalLight(0xffffff, 1.6);
    light.position.set(middle[0] - size, middle[1] - 1.5 * size, 3 * size);
    light.target.position.set(...middle, 0);
    light.castShadow = true;
    Object.assign(light.shadow.camera, { left: -size, right: size, top: size, bottom: -size, far: 8 * size });
    light.shadow.mapSize.set(1024, 1024);
    this.table = new three.Group(); // moves with the ground
    const outline = new three.Shape(corners.map(([x, y]) => new three.Vector2(x, y)));
    const floor = new three.Mesh(new three.ShapeGeometry(outline), new three.MeshLambertMaterial({ color: color("--paper"), side: three.DoubleSide }));
    floor.receiveShadow = true;
    this.table.add(floor, ...wallsOf(room).map((wall) => wallOf(wall, color("--line"))));
    for (const each of room.place ?? []) this.table.add(placeOf(room, each, color("--line")));
    for (const each of room.door ?? []) this.table.add(doorMark(each, color("--act")));
    this.bodies = new Map();
    const still = color("--line");
    for (const thing of room.thing ?? []) {
      const frames = film?.things.find((each) => each.name === thing.name);
      const body = frames ? simulated(frames, color("--act")) : standing(room, thing, still);
      if (frames) this.bodies.set(frames, body);
      this.table.add(body);
    }
    this.colors = { stands: color("--act"), falls: color("--fall") };
    this.scene.add(this.table, light, light.target);
    this.controls.target.set(...middle, 0.4);
    if (!this.size) this.camera.position.set(middle[0] + 0.6 * size, middle[1] - 1.7 * size, 1.3 * size);
    this.camera.far = 20 * size;
    this.camera.updateProjectionMatrix();
    this.size = size;
    this.middle = middle;
    this.controls.update();
  }

  // How far the camera goes round, from the front [°].
  set azimuth(degrees) {
    const angle = (degrees * Math.PI) / 180, [x, y] = this.middle;
    const { position } = this.camera;
    const far = Math.hypot(position.x - x, position.y - y);
    position.set(x + far * Math.sin(angle), y - far * Math.cos(angle), position.z);
    this.controls.update();
    this.render();
  }

  draw(thing, film, time) {
    const told = JSON.stringify(thing) + matchMedia("(prefers-color-scheme: dark)").matches;
    if (told !== this.told || film !== this.film) {
      Object.assign(this, { told, film });
      this.build(thing, film);
    }
    if (film) {
      const ground = film.ground_m[Math.min(Math.round(time * rateOf(film)), film.ground_m.length - 1)];
      this.table.position.set(...ground, 0);
      for (const [frames, body] of this.bodies) {
        const { position, turn } = poseAt(film, frames, time);
        body.position.set(...position);
        body.quaternion.copy(turn);
        const fallen = frames.outcome === "falls" && time * rateOf(film) >= frames.quaternion.length - 1;
        body.children[0].material.color.copy(fallen ? this.colors.falls : this.colors.stands);
      }
    }
    this.render();
  }
}

function wallOf({ start, along, inward, length }, color) {
  const material = new three.MeshLambertMaterial({ color, transparent: true, opacity: 0.35 }); // seen from inside alone
  const wall = new three.Mesh(new three.PlaneGeometry(length, HIGH), material);
  wall.position.set(start[0] + 0.5 * length * along[0], start[1] + 0.5 * length * along[1], HIGH / 2);
  wall.up.set(0, 0, 1);
  wall.lookAt(wall.position.x + inward[0], wall.position.y + inward[1], HIGH / 2);
  return wall;
}

function doorMark(door, color) {
  const mesh = new three.Mesh(new three.CircleGeometry((door.width_m ?? 0.9) / 2, SIDES), new three.MeshLambertMaterial({ color, transparent: true, opacity: 0.5 }));
  mesh.position.set(...door.at_m, 0.005);
  return mesh;
}

function prism(corners, low, high, color, opacity = 1) {
  const outline = new three.Shape(corners.map(([x, y]) => new three.Vector2(x, y)));
  const geometry = new three.ExtrudeGeometry(outline, { depth: high - low, bevelEnabled: false });
  const mesh = new three.Mesh(geometry, new three.MeshLambertMaterial({ color, transparent: opacity < 1, opacity }));
  mesh.position.z = low;
  mesh.castShadow = mesh.receiveShadow = opacity === 1;
  return mesh;
}

function placeOf(room, place, color) {
  const stands = place.kind === "bed" || place.kind === "desk";
  return prism(cornersOf(room, "place", place), 0, stands ? PLACE : 0.01, color, stands ? 0.8 : 0.25);
}

// What is not simulated: where it stands, half seen through.
function standing(room, thing, color) {
  const below = (room.thing ?? []).find((each) => each.name === thing.on)?.height_m ?? 0;
  return prism(cornersOf(room, "thing", thing), below, below + (thing.height_m ?? 1), color, 0.5);
}

// A thing about its centre of gravity, with lines on its front, as it was simulated.
function simulated({ base_m: [front, back, right, left], below_m: below, height_m: height, round }, color) {
  const length = back - front, width = left - right;
  const geometry = round
    ? new three.CylinderGeometry(length / 2, length / 2, height, SIDES).rotateX(Math.PI / 2)
    : new three.BoxGeometry(length, width, height);
  const mesh = new three.Mesh(geometry, new three.MeshLambertMaterial({ color }));
  mesh.castShadow = true;
  const line = new three.LineBasicMaterial({ color: 0xffffff });
  mesh.add(new three.LineSegments(new three.EdgesGeometry(geometry, 30), line));
  if (!round) {
    const shelves = [1, 2, 3].flatMap((k) => [-0.5, 0.5].map((side) => new three.Vector3(-0.505 * length, side * width, height * (k / 4 - 0.5))));
    mesh.add(new three.LineSegments(new three.BufferGeometry().setFromPoints(shelves), line));
  }
  mesh.position.set((front + back) / 2, (left + right) / 2, height / 2 - below);
  return new three.Group().add(mesh);
}
