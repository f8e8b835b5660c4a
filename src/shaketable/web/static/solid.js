// A box or a cylinder on its support, in three dimensions: one frame of the film at a time.
// As in the film, x is from its front to its back, y to its left and z up.

import * as three from "./vendor/three.module.min.js";
import { OrbitControls } from "./vendor/OrbitControls.js";
import { say } from "./texts.js";
import { behind, forceAt } from "./scene.js";
import { basesOf } from "./state.js";
import { RATE } from "./times.js";

const SIDES = 48; // of a circle

// Where an object is at a time: centre of gravity, turn, and the ground's displacement.
export function poseAt(film, time) {
  const { quaternion, position_m, ground_m } = film.frames;
  const last = quaternion.length - 1;
  const at = Math.min(time * RATE, last);
  const low = Math.floor(at), high = Math.min(low + 1, last), part = at - low;
  const mixed = (series) => series[low].map((value, k) => value + part * (series[high][k] - value));
  const turn = new three.Quaternion(...quaternion[low]);
  turn.slerp(new three.Quaternion(...quaternion[high]), part);
  return { position: mixed(position_m), turn, ground: mixed(ground_m) };
}

function atRest(thing) {
  const turn = new three.Quaternion();
  turn.setFromAxisAngle(new three.Vector3(0, 0, 1), ((thing.facing_deg ?? 0) * Math.PI) / 180);
  return { position: [0, 0, thing.cg_share * thing.height_m], turn, ground: [0, 0] };
}

// A view of a canvas; fails where the browser cannot draw in three dimensions.
export class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.camera = new three.PerspectiveCamera(30, 1.6, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableZoom: false, enablePan: false, maxPolarAngle: 0.49 * Math.PI });
    canvas.style.touchAction = "pan-y"; // a finger still scrolls the page
    this.controls.addEventListener("change", () => this.render());
  }

  // Browsers have room for some sixteen views.
  close() {
    this.clear();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.scene = null;
  }

  // How far the camera goes round, from the front [°].
  set azimuth(degrees) {
    const angle = (degrees * Math.PI) / 180;
    const { x, y, z } = this.camera.position;
    const far = Math.hypot(x, y);
    this.camera.position.set(-far * Math.cos(angle), -far * Math.sin(angle), z);
    this.controls.update();
    this.render();
  }

  // Frees what a scene holds on the graphics card.
  clear() {
    this.scene?.traverse((each) => {
      each.geometry?.dispose();
      each.material?.map?.dispose();
      each.material?.dispose();
      if (each.isLight) each.dispose();
    });
  }

  build(thing) {
    this.clear();
    const style = getComputedStyle(document.documentElement);
    const color = (name) => new three.Color(style.getPropertyValue(name).trim());
    const size = Math.hypot(...basesOf(thing), thing.height_m);
    this.scene = new three.Scene();
    this.scene.background = color("--soft");
    this.scene.add(new three.HemisphereLight(0xffffff, 0x888888, 1.6));
    const grid = new three.GridHelper(12 * size, 48, color("--line"), color("--line"));
    grid.rotation.x = Math.PI / 2;
    grid.position.z = -0.3 * size;
    Object.assign(grid.material, { transparent: true, opacity: 0.35 });
    this.scene.add(grid);
    this.table = new three.Group(); // moves with the ground
    this.table.rotation.y = (-thing.tilt_deg * Math.PI) / 180; // downhill is to its front
    const light = new three.DirectionalLight(0xffffff, 2);
    light.position.set(-1.8 * size, 1.2 * size, 3 * size);
    light.castShadow = true;
    Object.assign(light.shadow.camera, { left: -2 * size, right: 2 * size, top: 2 * size, bottom: -2 * size, far: 8 * size });
    light.shadow.mapSize.set(1024, 1024);
    const around = new three.Group(); // turns with the object
    around.rotation.z = ((thing.facing_deg ?? 0) * Math.PI) / 180;
    around.add(plateOf(thing, size, color));
    this.still = new three.Group(); // moves with the ground, and is not tilted
    if (thing.beside?.wall_gap_mm !== undefined) this.still.add(wallOf(thing, size, color));
    this.strap = thing.beside?.strap_slack_mm === undefined ? null : strap(color);
    if (this.strap) this.table.add(this.strap);
    this.colors = { loose: color("--ink"), taut: color("--fall") };
    this.body = made(thing, color);
    this.table.add(around, this.body, sign(size, style.getPropertyValue("--paper").trim()));
    this.scene.add(this.table, this.still, light);
    this.controls.target.set(0, 0, 0.35 * thing.height_m);
    if (!this.size) this.camera.position.set(-3.6, -2.2, 2).setLength(3.4 * size);
    else this.camera.position.multiplyScalar(size / this.size);
    this.size = size;
    this.controls.update();
  }

  draw(thing, film, time) {
    const told = JSON.stringify(thing) + say("front") + matchMedia("(prefers-color-scheme: dark)").matches;
    if (told !== this.told) { this.told = told; this.build(thing); }
    const { position, turn, ground } = film ? poseAt(film, time) : atRest(thing);
    this.body.position.set(...position);
    this.body.quaternion.copy(turn);
    for (const each of [this.table, this.still]) each.position.set(...ground, 0);
    if (this.strap) this.drawStrap(thing, film ? forceAt(film, time) : 0);
    this.render();
  }

  // From the middle of the top of its back to the wall, or to a point behind that.
  drawStrap(thing, force) {
    const { body, strap: line } = this;
    body.updateMatrix();
    const back = basesOf(thing)[0] / 2;
    const point = new three.Vector3(back, 0, (1 - thing.cg_share) * thing.height_m).applyMatrix4(body.matrix);
    const anchor = new three.Vector3(back + behind(thing.beside), 0, thing.height_m);
    anchor.applyAxisAngle(new three.Vector3(0, 0, 1), ((thing.facing_deg ?? 0) * Math.PI) / 180);
    line.geometry.setFromPoints([point, anchor]);
    line.material.color.copy(force > 0 ? this.colors.taut : this.colors.loose);
  }

  render() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!this.scene || !clientWidth) return;
    const sharp = Math.min(devicePixelRatio, 2);
    if (this.canvas.width !== Math.floor(clientWidth * sharp)) {
      this.renderer.setPixelRatio(sharp);
      this.renderer.setSize(clientWidth, clientHeight, false);
    }
    this.renderer.render(this.scene, this.camera);
  }
}

function boxOf(length, width, height, color) {
  const mesh = new three.Mesh(new three.BoxGeometry(length, width, height), new three.MeshLambertMaterial({ color }));
  mesh.receiveShadow = true;
  return mesh;
}

// The plate on which an object stands, cut at its edge, with the lip there.
function plateOf(thing, size, color) {
  const thick = 0.04 * size, far = 1.3 * size, edge = thing.beside?.edge_mm;
  const from = edge === undefined ? -far : -basesOf(thing)[0] / 2 - edge / 1000;
  const plate = boxOf(far - from, 2 * far, thick, color("--line"));
  plate.position.set((far + from) / 2, 0, -thick / 2);
  const high = (thing.beside?.lip_mm ?? 0) / 1000;
  if (high > 0) { // it begins at the edge and stands outside of it
    const lip = boxOf(0.01 * size, 2 * far, high + thick, color("--line"));
    lip.position.set(from - 0.005 * size - plate.position.x, 0, high / 2);
    plate.add(lip);
  }
  return plate;
}

// The wall behind it, which is vertical: its gap is from the nearest point of the object.
export function wallAt(thing) {
  const facing = ((thing.facing_deg ?? 0) * Math.PI) / 180, tilt = (thing.tilt_deg * Math.PI) / 180;
  const placed = (x, y, z) => new three.Vector3(x, y, z)
    .applyAxisAngle(new three.Vector3(0, 0, 1), facing).applyAxisAngle(new three.Vector3(0, 1, 0), -tilt);
  const toward = placed(1, 0, 0).setZ(0).normalize();
  const [half, across] = basesOf(thing).map((size) => size / 2);
  const corners = [];
  for (let k = 0; k < SIDES; k += 1) {
    const angle = (2 * Math.PI * k) / SIDES;
    const x = thing.shape === "box" ? half * Math.sign(Math.cos(angle)) : half * Math.cos(angle);
    const y = thing.shape === "box" ? across * Math.sign(Math.sin(angle)) : half * Math.sin(angle);
    for (const z of [0, thing.height_m]) corners.push(placed(x, y, z).dot(toward));
  }
  return { toward, far: Math.max(...corners) + thing.beside.wall_gap_mm / 1000 };
}

function wallOf(thing, size, color) {
  const thick = 0.04 * size, { toward, far } = wallAt(thing);
  const wall = boxOf(thick, 2 * basesOf(thing)[1], 1.4 * thing.height_m, color("--line"));
  wall.position.copy(toward).multiplyScalar(far + thick / 2).setZ(0.6 * thing.height_m);
  wall.rotation.z = Math.atan2(toward.y, toward.x);
  Object.assign(wall.material, { transparent: true, opacity: 0.6 });
  return wall;
}

function strap(color) {
  return new three.Line(new three.BufferGeometry(), new three.LineBasicMaterial({ color: color("--ink") }));
}

// A word on the support, before the object.
function sign(size, color) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 256, height: 64 });
  const context = canvas.getContext("2d");
  Object.assign(context, { font: "48px system-ui, sans-serif", textAlign: "center", fillStyle: color });
  context.fillText(say("front"), 128, 48);
  const map = new three.CanvasTexture(canvas);
  map.flipY = false; // WebGL flips no textures but flat ones, and complains; the plane is flipped instead
  const material = new three.MeshBasicMaterial({ map, transparent: true, side: three.DoubleSide });
  const word = new three.Mesh(new three.PlaneGeometry(0.8 * size, 0.2 * size), material);
  word.scale.y = -1;
  word.rotation.z = -Math.PI / 2; // read from before the object
  word.position.set(-0.9 * size, 0, 0.004 * size);
  return word;
}

// The object about its centre of gravity, with lines that show how it turns.
function made(thing, color) {
  const { shape, height_m } = thing, [depth, width] = basesOf(thing);
  let geometry;
  if (shape === "box") geometry = new three.BoxGeometry(depth, width, height_m);
  else geometry = new three.CylinderGeometry(depth / 2, depth / 2, height_m, SIDES).rotateX(Math.PI / 2);
  const solid = new three.Mesh(geometry, new three.MeshLambertMaterial({ color: color("--act") }));
  solid.castShadow = true;
  const points = [];
  const out = 0.502; // lines lie just outside
  if (shape === "box") {
    for (let k = 1; k < 4; k += 1) { // shelves at the front
      const z = height_m * (k / 4 - 0.5);
      points.push([-out * depth, -0.5 * width, z], [-out * depth, 0.5 * width, z]);
    }
  } else {
    for (let k = 0; k < 6; k += 1) {
      const angle = (k * Math.PI) / 3;
      const x = out * depth * Math.cos(angle), y = out * depth * Math.sin(angle);
      points.push([x, y, -0.5 * height_m], [x, y, 0.5 * height_m]);
    }
  }
  const line = new three.LineBasicMaterial({ color: color("--paper") });
  const stripes = new three.BufferGeometry().setFromPoints(points.map((each) => new three.Vector3(...each)));
  solid.add(new three.LineSegments(stripes, line), new three.LineSegments(new three.EdgesGeometry(geometry, 30), line));
  solid.position.z = (0.5 - thing.cg_share) * height_m;
  return new three.Group().add(solid);
}
