// What all pages share: their elements, how a refusal is told, and the link to the result.

import { Refused } from "./api.js";
import { say } from "./texts.js";

export const find = (id) => document.getElementById(id);

export function make(name, text = "", properties = {}) {
  return Object.assign(document.createElement(name), { textContent: text, ...properties });
}

// A failure in words.
export function told(error) {
  return error instanceof Refused && error.message ? say("failed", { detail: error.message }) : say("offline");
}

// The link to the result leaves the address as it is, which carries what was entered.
for (const link of document.querySelectorAll(".skip")) {
  link.addEventListener("click", (event) => {
    event.preventDefault();
    document.querySelector(link.hash).focus();
  });
}
