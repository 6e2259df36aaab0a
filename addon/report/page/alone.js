"use strict";
// A page of derivations and plots, and nothing else.

document.title = page.title;
document
  .querySelector("main")
  .append(...page.plots.map(plotFigure), ...page.derivations.map((one) => lecture(one)));
