// Finds rows of a library by words and choices, and draws the function of the chosen one.
const AT_ONCE = 50;
const CHOICES = ["limit_state", "measure", "place", "held"];
const rows = DATA.rows.map(row => Object.fromEntries(row.map((value, k) => [DATA.columns[k], value])));
const at = id => document.getElementById(id);
let most = AT_ONCE, found = rows, chosen = null;

function number(value, digits = 3) {
  return value === null ? "–" : String(Number(value.toPrecision(digits)));
}

function shown(row, name) {
  const [, factor] = DATA.units[row.measure];
  return row[name] === null ? "–" : number(row[name] * factor);
}

// 1, 2 or 5 times a power of ten, not below a value
function round(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find(each => each * power >= value);
}

function fill() {
  for (const name of CHOICES) {
    const values = [...new Set(rows.map(row => row[name]))];
    at(name).append(...["any", ...values].map(value => new Option(value, value)));
  }
  if (rows.some(row => row.limit_state === "overturns")) at("limit_state").value = "overturns";
  if (rows.some(row => row.measure === "PGV")) at("measure").value = "PGV";
}

function find() {
  const words = at("words").value.toLowerCase().split(/\s+/).filter(Boolean);
  found = rows.filter(row =>
    CHOICES.every(name => at(name).value === "any" || row[name] === at(name).value) &&
    words.every(word => `${row.id} ${row.thing} ${row.held} ${row.place}`.toLowerCase().includes(word)));
  list();
}

function list() {
  const known = found.filter(row => row.median !== null).length;
  at("count").textContent = `${found.length} ${found.length === 1 ? "row" : "rows"}, ${known} of them with a function.`;
  at("rows").replaceChildren(...found.slice(0, most).map(line));
  at("more").hidden = found.length <= most;
}

function line(row) {
  const [unit] = DATA.units[row.measure];
  const interval = row.median_low === null ? "–" : `${shown(row, "median_low")} to ${shown(row, "median_high")}`;
  const cells = [row.thing, row.place, row.held, row.tilt ? `${row.tilt}°` : "0°", row.limit_state, row.measure,
    row.median === null ? "none" : `${shown(row, "median")} ${unit}`, interval, number(row.beta, 2)];
  const tr = document.createElement("tr");
  tr.tabIndex = 0;
  tr.className = row === chosen ? "chosen" : "";
  cells.forEach((text, k) => {
    const td = document.createElement("td");
    td.textContent = text;
    if (k < 3 || k === 4) td.className = "text";
    tr.append(td);
  });
  const choose = () => { chosen = row; list(); show(row); };
  tr.addEventListener("click", choose);
  tr.addEventListener("keydown", event => { if (event.key === "Enter") choose(); });
  return tr;
}

// Φ after Abramowitz and Stegun (1964), 7.1.26: to 1.5e-7
function phi(z) {
  const x = Math.abs(z) / Math.SQRT2, t = 1 / (1 + 0.3275911 * x);
  const sum = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  const erf = 1 - sum * Math.exp(-x * x);
  return z < 0 ? (1 - erf) / 2 : (1 + erf) / 2;
}

function show(row) {
  const [unit] = DATA.units[row.measure];
  const said = {
    "Name": row.id,
    "Size": `${number(row.depth)} m deep, ${number(row.width)} m wide, ${number(row.height)} m high`,
    "Centre of gravity": `at ${row.cg_low} to ${row.cg_high} of the height`,
    "Friction": `${row.friction_low} to ${row.friction_high}`,
    "θ": row.median === null ? "none" : `${shown(row, "median")} ${unit}, 95 %: ${shown(row, "median_low")} to ${shown(row, "median_high")}`,
    "β": `${number(row.beta, 2)}: motions ${number(row.beta_motions, 2)}, object ${number(row.beta_object, 2)}, model ${number(row.beta_model, 2)}`,
    "From": `${row.simulations} simulations of ${row.recordings} recordings of ${row.events} earthquakes; ${row.recordings_reaching} recordings reach the state`,
    "Given up in motion": `${number(100 * row.given_up, 2)} % of the simulations, which have not overturned`,
    "No function": row.problem || "",
    "Caution": row.caution || "",
  };
  at("about").replaceChildren(...Object.entries(said).filter(([, value]) => value).flatMap(([name, value]) => {
    const dt = document.createElement("dt"), dd = document.createElement("dd");
    dt.textContent = name;
    dd.textContent = value;
    return [dt, dd];
  }));
  at("plot").replaceChildren(...(row.median === null ? [document.createTextNode("This row has no function.")] : [drawn(row)]));
}

function drawn(row) {
  const [unit, factor] = DATA.units[row.measure];
  const W = 480, H = 300, left = 50, bottom = 42, top = 10, right = 12;
  const end = row.median * Math.exp(2.5 * row.beta);
  const x = value => left + (W - left - right) * value / end, y = p => H - bottom - (H - bottom - top) * p;
  const levels = Array.from({ length: 121 }, (_, k) => end * (k + 0.5) / 121);
  const curve = median => levels.map(level => [x(level), y(phi(Math.log(level / median) / row.beta))]);
  const path = points => points.map(([a, b], k) => `${k ? "L" : "M"}${a.toFixed(1)} ${b.toFixed(1)}`).join("");
  const svg = (name, attributes, text = "") => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.textContent = text;
    return element;
  };
  const picture = svg("svg", { viewBox: `0 0 ${W} ${H}`, role: "img",
    "aria-label": `Probability of ${row.limit_state} over ${row.measure} in ${unit}` });
  if (row.median_low !== null) {
    const band = [...curve(row.median_low), ...curve(row.median_high).reverse()];
    picture.append(svg("path", { d: path(band) + "Z", fill: "#1b6ca8", opacity: 0.18 }));
  }
  picture.append(svg("path", { d: path(curve(row.median)), fill: "none", stroke: "#1b6ca8", "stroke-width": 2 }));
  const ink = { fill: "currentColor", "font-size": 12 };
  for (const p of [0, 0.25, 0.5, 0.75, 1]) {
    picture.append(svg("line", { x1: left, x2: W - right, y1: y(p), y2: y(p), stroke: "currentColor", opacity: 0.15 }));
    picture.append(svg("text", { x: left - 6, y: y(p) + 4, "text-anchor": "end", ...ink }, String(p)));
  }
  for (let tick = 0, step = round(end * factor / 5); tick <= end * factor; tick += step) {
    picture.append(svg("text", { x: x(tick / factor), y: H - bottom + 16, "text-anchor": "middle", ...ink }, number(tick)));
  }
  picture.append(svg("text", { x: (left + W) / 2, y: H - 6, "text-anchor": "middle", ...ink }, `${row.measure} [${unit}]`));
  picture.append(svg("text", { x: 12, y: (H - bottom) / 2, transform: `rotate(-90 12 ${(H - bottom) / 2})`, "text-anchor": "middle", ...ink }, `probability of: ${row.limit_state}`));
  return picture;
}

fill();
find();
at("words").addEventListener("input", () => { most = AT_ONCE; find(); });
for (const name of CHOICES) at(name).addEventListener("change", () => { most = AT_ONCE; find(); });
at("more").addEventListener("click", () => { most += AT_ONCE; list(); });
