// A verdict in a sentence.

import { number, say } from "./texts.js";

const ROCKS = 0.01; // °
const MOVES = 0.001; // m
const TURNS = 1; // °

// How one shaking ended; `length` says a length in words.
export function sentence(film, length) {
  const said = [film.moving ? say("moving") : how(film, length)];
  if (film.lift_m > MOVES && !film.off_edge) said.push(say("jumps", { lift: length(film.lift_m) }));
  if (film.off_edge) said.push(say("off_edge"));
  if (film.held_up) said.push(say("ends_held_up"));
  if (film.strap_peak !== null) said.push(say("strap_bore", { force: number(film.strap_peak) }));
  return said.join(" ");
}

function how(film, length) {
  if (film.outcome !== "standing") return say(`falls_${film.outcome}`, { time: number(film.time_s, 3) });
  const moved = film.slip_m ?? film.moved_m;
  const values = {
    peak: number(film.peak_deg), tips: number(film.tips_at_deg), slip: length(moved),
    turned: number(Math.abs(film.turned_deg ?? 0)),
  };
  const rocks = film.peak_deg > ROCKS, slid = moved > MOVES;
  const turn = Math.abs(film.turned_deg ?? 0) > TURNS ? ` ${say("turned", values)}` : "";
  if (film.frames.quaternion) {
    if (!rocks && !slid) return say("stands_still") + turn;
    return say(slid ? "leans_moved" : "leans", values) + turn;
  }
  if (rocks) return say(slid ? "stands_slid" : "stands", values);
  return say(slid ? "slid" : "stands_still", values);
}
