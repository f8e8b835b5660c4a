// The player of a film: the picture, its time, and the ground's trace below.

import { axes } from "./chart.js";
import { draw } from "./scene.js";
import { lengthOf, startOf } from "./times.js";
import { fixed, number, say } from "./texts.js";

const still = matchMedia("(prefers-reduced-motion: reduce)");

function make(name, properties = {}) {
  return Object.assign(document.createElement(name), properties);
}

let made = 0; // players, whose labels name their fields

export class Player {
  // In a place of the page; `length` says a length in words.
  constructor(place, length) {
    const id = (made += 1);
    this.place = place;
    this.length = length;
    this.film = null;
    this.time = 0;
    this.playing = false;
    this.flat = make("canvas", { className: "scene", width: 800, height: 500 });
    this.deep = make("canvas", { className: "scene", hidden: true });
    for (const canvas of [this.flat, this.deep]) canvas.setAttribute("role", "img");
    this.round = make("input", { type: "range", id: `round-${id}`, min: 0, max: 359, step: 5, value: 30 });
    this.around = make("p", { className: "player", hidden: true });
    this.around.append(make("label", { htmlFor: this.round.id }), this.round);
    this.button = make("button", { type: "button", className: "second play" });
    this.slider = make("input", { type: "range", id: `time-${id}`, className: "time", min: 0, step: "any", value: 0 });
    this.now = make("output", { className: "now" });
    this.trace = make("div", { className: "chart trace" });
    this.bar = make("div", { hidden: true });
    const line = make("p", { className: "player" });
    line.append(this.button, make("label", { htmlFor: this.slider.id }), this.slider, this.now);
    this.bar.append(line, this.trace);
    this.told = make("p", { className: "small" });
    place.replaceChildren(this.flat, this.deep, this.told, this.around, this.bar);
    this.button.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => {
      this.playing = false;
      this.time = Number(this.slider.value);
      this.moment();
    });
    this.round.addEventListener("input", () => { this.view.azimuth = Number(this.round.value); });
    this.dress();
  }

  // The words, in another language.
  dress() {
    for (const canvas of [this.flat, this.deep]) canvas.setAttribute("aria-label", say("scene"));
    this.around.querySelector("label").textContent = say("round");
    this.bar.querySelector("label").textContent = say("time");
    if (this.film) this.chart();
    if (this.thing) this.prepare();
  }

  // Leave the place empty, for another player.
  close() {
    this.closed = true;
    this.playing = false;
    this.view?.close();
    this.place.replaceChildren();
  }

  // A thing that stands, with no film yet.
  rest(thing) {
    Object.assign(this, { film: null, thing, playing: false });
    this.bar.hidden = true;
    this.prepare();
  }

  show(film, thing) {
    const time = still.matches ? lengthOf(film) : startOf(film);
    Object.assign(this, { film, thing, time, playing: false });
    this.bar.hidden = false;
    this.prepare();
    this.chart();
    if (!still.matches) this.toggle();
  }

  // What draws three dimensions is fetched when it is wanted for the first time.
  prepare() {
    const shape = this.thing.shape ?? this.thing.room; // what has none is seen from the side
    this.flat.hidden = Boolean(shape);
    this.deep.hidden = this.around.hidden = !shape || !this.view;
    this.told.textContent = shape && this.view === null ? say("no_space") : "";
    if (shape && !this.loading) this.loading = this.load();
    this.redraw();
  }

  async load() {
    let View;
    try {
      if (this.thing.room) ({ RoomView: View } = await import("./room_view.js"));
      else ({ View } = await import("./solid.js"));
    } catch { // it is asked for again with the next thing
      this.loading = null;
      this.told.textContent = say("offline");
      return;
    }
    if (this.closed) return;
    try {
      this.view = new View(this.deep);
    } catch { // no WebGL
      this.view = null;
    }
    this.prepare();
  }

  chart() {
    const { acceleration_g, time_step_s, peak_g, name } = this.film.ground;
    const end = Math.max(lengthOf(this.film), (acceleration_g.length - 1) * time_step_s);
    this.slider.max = lengthOf(this.film);
    const chart = axes(this.trace, {
      x: [0, end], y: [-peak_g || -1, peak_g || 1], xText: `${say("time")} [${say("seconds")}]`, yText: "g",
      label: `${say("trace")}: ${name}`, format: (value) => number(value),
    });
    chart.line(acceleration_g.map((a, k) => [k * time_step_s, a]));
    this.point = chart.cursor();
    this.moment();
  }

  moment() {
    this.slider.value = this.time;
    this.now.textContent = `${fixed(this.time)} ${say("seconds")}`;
    this.button.textContent = say(this.playing ? "pause" : "play");
    this.point(this.time);
    this.redraw();
  }

  redraw() {
    if (this.thing.shape ?? this.thing.room) this.view?.draw(this.thing, this.film, this.time);
    else draw(this.flat, this.thing, this.film, this.time, this.length);
  }

  toggle() {
    const end = lengthOf(this.film);
    if (!this.playing && this.time >= end) this.time = startOf(this.film);
    this.playing = !this.playing;
    let last = null;
    const play = (now) => {
      if (!this.playing) return;
      if (last !== null) this.time = Math.min(this.time + (now - last) / 1000, end);
      last = now;
      if (this.time >= end) this.playing = false;
      this.moment();
      if (this.playing) this.loop = requestAnimationFrame(play);
    };
    cancelAnimationFrame(this.loop);
    this.loop = requestAnimationFrame(play);
    this.moment();
  }
}
