// Small charts as SVG: lines and a band over two axes.

const NS = "http://www.w3.org/2000/svg";
const HIGH = 220;
const LEFT = 52, RIGHT = 12, TOP = 12, BOTTOM = 42;
const NARROW = 320, WIDEST = 640; // so that letters are as large on a telephone

export function element(name, attributes = {}, text = "") {
  const made = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text) made.textContent = text;
  return made;
}

function ticks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough);
  const found = [];
  for (let at = Math.ceil(low / step - 1e-9) * step; at <= high + 1e-9 * step; at += step) found.push(at);
  return found;
}

// An empty chart in a place; gives functions from values to the picture.
export function axes(place, { x, y, logarithmic = false, xText, yText, label, format }) {
  const wide = Math.min(Math.max(place.clientWidth, NARROW), WIDEST);
  const svg = element("svg", { viewBox: `0 0 ${wide} ${HIGH}`, role: "img", "aria-label": label });
  const along = logarithmic ? Math.log : (value) => value;
  const [x0, x1] = x.map(along);
  const toX = (value) => LEFT + ((along(value) - x0) / (x1 - x0)) * (wide - LEFT - RIGHT);
  const toY = (value) => HIGH - BOTTOM - ((value - y[0]) / (y[1] - y[0])) * (HIGH - TOP - BOTTOM);
  svg.append(element("path", { class: "axis", d: `M${LEFT} ${TOP}V${HIGH - BOTTOM}H${wide - RIGHT}` }));
  const marks = logarithmic
    ? [0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 4, 10].filter((at) => at >= x[0] && at <= x[1])
    : ticks(x[0], x[1], wide / 100);
  for (const at of marks) {
    svg.append(element("path", { class: "axis", d: `M${toX(at)} ${HIGH - BOTTOM}v5` }));
    svg.append(element("text", { x: toX(at), y: HIGH - BOTTOM + 18, "text-anchor": "middle" }, format(at)));
  }
  for (const at of ticks(y[0], y[1], 5)) {
    svg.append(element("path", { class: "axis", d: `M${LEFT} ${toY(at)}h-5` }));
    svg.append(element("text", { x: LEFT - 8, y: toY(at) + 4, "text-anchor": "end" }, format(at)));
  }
  svg.append(element("text", { x: (LEFT + wide - RIGHT) / 2, y: HIGH - 6, "text-anchor": "middle" }, xText));
  svg.append(element("text", { x: 0, y: 0, transform: `translate(13 ${(HIGH - BOTTOM + TOP) / 2}) rotate(-90)`, "text-anchor": "middle" }, yText));
  place.replaceChildren(svg);
  const path = (points) => points.map(([px, py], k) => `${k ? "L" : "M"}${toX(px).toFixed(1)} ${toY(py).toFixed(1)}`).join("");
  return {
    line(points) { svg.append(element("path", { class: "line", d: path(points) })); },
    band(low, high) {
      svg.append(element("path", { class: "band", d: `${path(low)}${path([...high].reverse()).replace("M", "L")}Z` }));
    },
    dots(points) {
      for (const [px, py] of points) svg.append(element("circle", { class: "dot", cx: toX(px), cy: toY(py), r: 3.5 }));
    },
    cursor() {
      const made = element("path", { class: "cursor", d: `M0 ${TOP}V${HIGH - BOTTOM}` });
      svg.append(made);
      return (value) => made.setAttribute("transform", `translate(${toX(value)} 0)`);
    },
  };
}
