// Questions to the server, which may ask to wait.

const VISITOR = crypto.getRandomValues(new Uint32Array(2)).join("-"); // gone with the page
const TRIES = 5;

export class Refused extends Error {}

async function send(path, options, waits) {
  for (let tries = 1; ; tries += 1) {
    let answer;
    try {
      answer = await fetch(`api/${path}`, {
        ...options, headers: {
          ...options.headers, "X-Visitor": VISITOR, "Accept-Language": document.documentElement.lang,
        },
      });
    } catch (error) {
      if (error.name === "AbortError") throw error;
      throw new Refused("");
    }
    if (answer.status === 204) return null;
    const found = await answer.json();
    if (answer.ok) return found;
    if (answer.status !== 429 || tries === TRIES) throw new Refused(found.detail);
    const wait = Number(answer.headers.get("Retry-After")) || 1;
    waits(wait);
    await new Promise((done) => setTimeout(done, 1000 * wait));
  }
}

const nothing = () => {};

export function ask(path, question, { signal, waits = nothing } = {}) {
  const body = JSON.stringify(question);
  const headers = { "Content-Type": "application/json" };
  return send(path, { method: "POST", headers, body, signal }, waits);
}

export function motions() {
  return send("motions", {}, nothing);
}

const LONGEST = 120; // letters of a file's name; its ending tells the format

// A list, read: `sheet` is the one of a workbook, `columns` the text that says what columns mean.
export function understand(name, data, { sizes, catalogue, sheet, columns = "", rows = "" }, waits) {
  const asked = { name: name.slice(-LONGEST), accept_sizes: sizes, catalogue, columns, rows, ...(sheet && { sheet }) };
  return send(`list?${new URLSearchParams(asked)}`, { method: "PUT", body: data }, waits);
}

// The hazard curve of a site: levels of shaking, each by how seldom it comes.
export function readHazard(file, waits) {
  return send(`hazard?${new URLSearchParams({ name: file.name.slice(-LONGEST) })}`, { method: "PUT", body: file }, waits);
}

// A room's file, read: its tables and its faults.
export function readRoom(name, data, waits) {
  return send(`room?${new URLSearchParams({ name: name.slice(-LONGEST) })}`, { method: "PUT", body: data }, waits);
}

export function beginRoom(question) {
  return ask("room/assess", question);
}

export function begin(question) {
  return ask("assess", question);
}

export function result(job) {
  return send(`assess/${job}`, {}, nothing);
}

export function stop(job) {
  return send(`assess/${job}`, { method: "DELETE" }, nothing);
}

// How a job is, each time that changes; `gone` if there is no such job any more.
export function watch(job, told, gone) {
  const events = new EventSource(`api/assess/${job}/events`);
  events.onmessage = (event) => told(JSON.parse(event.data));
  events.onerror = () => { if (events.readyState === EventSource.CLOSED) gone(); };
  return events;
}

// A record; `given` is what its file may not say.
export function read(file, given, waits) {
  const name = file.name.slice(-LONGEST);
  return send(`record?${new URLSearchParams({ name, ...given })}`, { method: "PUT", body: file }, waits);
}
