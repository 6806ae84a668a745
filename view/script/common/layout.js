// What every page has: the picture with its legend, a panel beside it, and below it what is said of what was picked.

// `chosen`: what a click on a point chooses, if anything.
function layout(page, chosen = "") {
  const parts = {
    stage: element("div", { id: "stage" }), legend: element("div", { id: "legend" }), buttons: element("div", { class: "buttons" }),
    panel: element("div", { id: "panel" }), story: element("section", { id: "story", "aria-live": "polite" }) };
  page.replaceChildren(
    element("div", {}, parts.stage, parts.buttons,
            element("p", { class: "small" }, `Drag to turn, right drag or two fingers to move, wheel or pinch to come nearer${chosen && `, click or tap a point to choose ${chosen}`}. ` +
                                                  "With the keyboard: arrow keys turn, + and − come nearer.")),
    parts.panel, parts.story);
  parts.stage.append(parts.legend);
  return parts;
}

const button = (text, press) => element("button", { type: "button", onclick: press }, text);

// A colour and what it stands for.
const swatch = (colour, text) => element("span", { class: "swatch" }, element("i", { style: `background: ${colour}` }), text);
