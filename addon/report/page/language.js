"use strict";
// The page in the reader's language. Each text of its own that the language's table has is shown
// translated, also what other scripts write later. Names and numbers stay as they are.

const LANGUAGES = JSON.parse(byId("languages").textContent);
const TOLD = ["title", "aria-label", "data-head"]; // attributes that are read
const NAMES = new Set([...page.objects, ...page.comparison.scene.objects.map((o) => o.name)]);
const originals = new WeakMap(); // by node: attribute, or "" -> [English, as shown]

let sentences = {}; // of the language, by their English
let patterns = []; // [RegExp, translation] of those with names or numbers in them

/** A text in the reader's language; as it is where the table has nothing for it. */
function translated(text) {
  const core = text.replace(/\s*\n\s*/g, " ").trim();
  if (NAMES.has(core) || !/\p{L}/u.test(core)) return text;
  const found = sentences[core] ?? inParts(core);
  return found === core ? text : text.match(/^\s*/)[0] + found + text.match(/\s*$/)[0];
}

/** Sentence by sentence; a sentence as a pattern has it, else its parts about colons. */
function inParts(text) {
  for (const gap of [/^([:–] )/, /(:)$/, /( {2}·? *)/, /(?<=\S\.)( )/]) {
    if (gap.test(text)) return text.split(gap).map(translated).join("");
  }
  for (const [pattern, said] of patterns) {
    const [, ...held] = pattern.exec(text) ?? [];
    if (held.length) return said.replace(/\{(\d)[^}]*\}/g, (_, k) => translated(held[k]));
  }
  return text.includes(": ") ? text.split(/(: )/).map(translated).join("") : text;
}

/** Show a text of a node, from `read`, in the language: its English is kept for another one. */
function show(node, key, read, write) {
  if (!originals.has(node)) originals.set(node, {});
  const known = originals.get(node)[key];
  const english = known && known[1] === read ? known[0] : read;
  const said = translated(english);
  originals.get(node)[key] = [english, said];
  if (said !== read) write(said);
}

function showAll(root) {
  const ours = (node) => !(node.parentElement ?? node).closest("script, style, svg, [translate=no]");
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
  for (let node = root; node; node = walker.nextNode()) {
    if (!ours(node)) continue;
    if (node.nodeType === Node.TEXT_NODE) show(node, "", node.data, (said) => (node.data = said));
    for (const name of TOLD)
      if (node.hasAttribute?.(name))
        show(node, name, node.getAttribute(name), (said) => node.setAttribute(name, said));
  }
}

const written = new MutationObserver((changes) => {
  for (const { type, target, addedNodes } of changes)
    for (const node of type === "childList" ? addedNodes : [target])
      if (node.isConnected) showAll(node);
  written.takeRecords();
});

/** Show the page in a language, named as in `navigator.language`. */
function speak(code) {
  sentences = LANGUAGES[code] ?? {};
  patterns = Object.entries(sentences)
    .filter(([english]) => english.includes("{"))
    .sort(([a], [b]) => b.length - a.length)
    .map(([english, said]) => [patternOf(english), said]);
  document.documentElement.lang = code;
  byId("language").value = code;
  written.disconnect();
  showAll(document.body);
  const what = { childList: true, characterData: true, attributeFilter: TOLD };
  if (code !== "en") written.observe(document.body, { subtree: true, ...what });
  redraw();
}

/** What matches an English text with anything in place of {0}, and a number in that of {1:,}. */
function patternOf(english) {
  const parts = english.split(/(\{[^}]*\})/).map((part) => {
    if (part.startsWith("{")) return part.includes(":") ? "([-−+\\d.,e∞]+)" : "(.+?)";
    return part.replace(/[.*+?^$()|[\]\\]/g, "\\$&");
  });
  return new RegExp(`^${parts.join("")}$`, "u");
}

/** Let the reader choose, and begin with the browser's language. */
function chooseLanguage() {
  const choice = byId("language");
  const nameOf = (code) => new Intl.DisplayNames([code], { type: "language" }).of(code);
  choice.replaceChildren(
    ...["en", ...Object.keys(LANGUAGES)].map((code) =>
      element("option", { value: code, translate: "no" }, nameOf(code)),
    ),
  );
  choice.addEventListener("change", () => speak(choice.value));
  const [own] = navigator.language.split("-");
  if (own in LANGUAGES) speak(own);
}
