"use strict";
// The page of an animation: its curves above its table.

byId("curves").append(...page.plots.map(plotFigure));
