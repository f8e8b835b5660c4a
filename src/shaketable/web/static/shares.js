// What a thing does in many shakings.

import { ask } from "./api.js";
import { axes } from "./chart.js";
import { find } from "./page.js";
import { pathOf } from "./state.js";
import { number, say } from "./texts.js";

// The answer; of what is three-dimensional, or stands beside something, first the share alone, and then with its curve.
export async function* many(thing, scale, options) {
  const path = pathOf(thing, "many");
  if (!thing.shape && !thing.beside) {
    yield await ask(path, { thing, scale }, options);
    return;
  }
  yield await ask(path, { thing, scale, curve: false }, options);
  yield await ask(path, { thing, scale }, options);
}

// The share in a sentence.
export function shareOf(found) {
  const values = {
    falls: number(found.falls, 4), simulations: number(found.simulations, 4), share: found.in_100.share,
    moving: number(found.moving, 4), held_up: number(found.held_up ?? 0, 4), force: number(found.strap_90 ?? 0),
  };
  const falls = found.falls ? "share" : "share_none";
  const said = [say(found.held_up ? "share_held_up" : falls, values)];
  if (found.moving) said.push(say("still_moving", values));
  if (found.strap_90 !== null) said.push(say("strap_bears", values));
  return said.join(" ");
}

// What goes with it.
export function showShares(found, scale, thing) {
  const left = found.left ?? found.sides.left, right = found.sides?.right ?? found.falls - found.left;
  const values = {
    simulations: number(found.simulations, 4), recordings: found.recordings,
    low: found.in_100.low, high: found.in_100.high,
    left, right, front: found.sides?.front, back: found.sides?.back, pga: number(found.median_pga_g),
  };
  const one = thing.friction === null ? "" : ` ${say("one_friction", { friction: number(thing.friction) })}`;
  find("sure").textContent = say("sure", values) + one;
  const more = [];
  if (found.falls) more.push(say(found.sides ? "sides_space" : "sides", values));
  find("sides").textContent = more.join(" ");
  find("curve-help").textContent = say("curve_help", values);
  find("curve").replaceChildren();
  const points = found.curve;
  if (!points.length) return;
  const chart = axes(find("curve"), {
    x: [points[0].scale, points.at(-1).scale], y: [0, 100], logarithmic: true, xText: say("curve_x"),
    yText: say("curve_y"), label: say("curve_title"), format: (value) => number(value),
  });
  chart.band(points.map((p) => [p.scale, 100 * p.low]), points.map((p) => [p.scale, 100 * p.high]));
  chart.line(points.map((p) => [p.scale, 100 * p.share]));
  chart.dots(points.map((p) => [p.scale, 100 * p.share]));
  chart.cursor()(Math.min(Math.max(scale, points[0].scale), points.at(-1).scale));
}
