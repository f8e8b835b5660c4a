// What all pages share: their elements, what is told of a failure, and the link to the result.

import { Refused } from "./api.js";

export const find = (id) => document.getElementById(id);

export function make(name, text = "", properties = {}) {
  return Object.assign(document.createElement(name), { textContent: text, ...properties });
}

// A failure in words: their key and values.
export function failure(error) {
  return error instanceof Refused && error.message ? ["failed", { detail: error.message }] : ["offline", {}];
}

// The link to the result leaves the address as it is, which carries what was entered.
for (const link of document.querySelectorAll(".skip")) {
  link.addEventListener("click", (event) => {
    event.preventDefault();
    document.querySelector(link.hash).focus();
  });
}
