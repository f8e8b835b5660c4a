// What a thing does in many shakings.

import { ask } from "./api.js";
import { axes } from "./chart.js";
import { find } from "./page.js";
import { pathOf } from "./state.js";
import { inHundred, number, say } from "./texts.js";

// The answer; of what is three-dimensional first the share alone, and then with its curve.
export async function* hundred(thing, scale, strap, options) {
  const path = pathOf(thing, "many");
  if (!thing.shape) {
    yield await ask(path, { thing, scale, strap_n_kg: strap }, options);
    return;
  }
  yield await ask(path, { thing, scale, curve: false }, options);
  yield await ask(path, { thing, scale }, options);
}

// The share in a sentence.
export function shareOf(found, strap) {
  const bare = strap && found.force_n_kg !== undefined ? `${say("bare")} ` : "";
  return bare + say(found.falls ? "share" : "share_none", {
    falls: number(found.falls, 4), simulations: number(found.simulations, 4), share: inHundred(found.share),
  });
}

// What goes with it.
export function showShares(found, scale, strap) {
  const left = found.left ?? found.sides.left, right = found.sides?.right ?? found.falls - found.left;
  const values = {
    simulations: number(found.simulations, 4), recordings: found.recordings,
    low: inHundred(found.low), high: inHundred(found.high),
    left, right, front: found.sides?.front, back: found.sides?.back, pga: number(found.median_pga_g),
    moving: number(found.moving ?? 0, 4), force: number(found.force_n_kg ?? 0), strap: number(strap),
    holds: number(found.strap_holds ?? 0, 4),
  };
  find("sure").textContent = say("sure", values);
  const more = [];
  if (found.falls) more.push(say(found.sides ? "sides_space" : "sides", values));
  if (found.moving) more.push(say("still_moving", values));
  if (found.force_n_kg) more.push(say("force", values));
  if (found.force_n_kg && strap) more.push(say("strap_holds", values));
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
