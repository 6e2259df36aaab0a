"use strict";
// Light or dark: what the system says, until somebody asks for the other one here. In the head, so
// that a dark page is never seen light first.

const dark = matchMedia("(prefers-color-scheme: dark)");

function followSystem() {
  document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
}
followSystem();
dark.addEventListener("change", followSystem);

/** Set light or dark in place of the system's choice. */
function toggleTheme() {
  dark.removeEventListener("change", followSystem);
  const { dataset } = document.documentElement;
  dataset.theme = dataset.theme === "dark" ? "light" : "dark";
  redraw();
}
