"use strict";
// The page of one pixel: its derivation, and nothing else.

const [shown] = page.derivations;
document.title = shown.blocks[0].text;
document.querySelector("main").append(lecture(shown));
