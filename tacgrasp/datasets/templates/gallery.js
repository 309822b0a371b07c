"use strict";
const cards = [...document.querySelectorAll("main article")];
const bars = [...document.querySelectorAll("button.bar")];
const search = document.getElementById("search");
const doubtful = document.getElementById("doubtful");
const detail = document.getElementById("detail");
const texts = new Map(cards.map((card) => [card, card.textContent.toLowerCase()]));
let opened = -1;

if (matchMedia("(max-width: 860px)").matches) {
  document.getElementById("classes").open = false;
}

// Classes of one dimension widen what is shown, dimensions and words narrow it.
function filter() {
  const wanted = {};
  for (const bar of bars.filter((each) => each.ariaPressed === "true")) {
    (wanted[bar.dataset.slot] ??= new Set()).add(bar.dataset.word);
  }
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  for (const card of cards) {
    const named = Object.entries(wanted).every(([slot, set]) => set.has(card.dataset[slot]));
    const said = words.every((word) => texts.get(card).includes(word));
    card.hidden = !(named && said && (!doubtful.checked || card.dataset.doubt === "1"));
  }
  const count = shown().length;
  document.getElementById("count").textContent = `${count} of ${cards.length} shown`;
  document.getElementById("none").hidden = count > 0;
}

function shown() {
  return cards.filter((card) => !card.hidden);
}

function element(name, text, parent) {
  const made = document.createElement(name);
  made.textContent = text;
  parent.append(made);
  return made;
}

function open(place) {
  const list = shown();
  opened = (place + list.length) % list.length;
  const copy = list[opened].cloneNode(true);
  copy.removeAttribute("tabindex");
  const more = element("div", "", copy);
  more.className = "more";
  for (const [title, pairs] of Object.entries(JSON.parse(copy.dataset.more))) {
    const part = element("section", "", more);
    element("h4", title, part);
    const rows = element("dl", "", part);
    for (const [name, text] of pairs) {
      element("dt", name, rows);
      element("dd", text, rows);
    }
  }
  const turn = element("div", "", copy);
  turn.className = "turn";
  element("button", "← previous", turn).onclick = () => open(opened - 1);
  element("button", "next →", turn).onclick = () => open(opened + 1);
  element("button", "close", turn).onclick = () => detail.close();
  detail.replaceChildren(copy);
  if (!detail.open) detail.showModal();
}

for (const bar of bars) {
  bar.addEventListener("click", () => {
    bar.ariaPressed = bar.ariaPressed === "true" ? "false" : "true";
    filter();
  });
}
for (const card of cards) {
  card.addEventListener("click", () => open(shown().indexOf(card)));
  card.addEventListener("keydown", (event) => {
    if (event.key === "Enter") open(shown().indexOf(card));
  });
}
search.addEventListener("input", filter);
doubtful.addEventListener("change", filter);
document.getElementById("reset").addEventListener("click", () => {
  search.value = "";
  doubtful.checked = false;
  for (const bar of bars) bar.ariaPressed = "false";
  filter();
});
detail.addEventListener("click", (event) => {
  if (event.target === detail) detail.close();
});
document.addEventListener("keydown", (event) => {
  if (detail.open && event.key === "ArrowLeft") open(opened - 1);
  if (detail.open && event.key === "ArrowRight") open(opened + 1);
  if (!detail.open && event.key === "/" && document.activeElement !== search) {
    event.preventDefault();
    search.focus();
  }
});
