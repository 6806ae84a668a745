// Small helpers of the page.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function drawn(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const word = (kind, text) => element("span", { class: kind }, text);

function choice(title, name, options, chosen, change) {
  return element("fieldset", {}, element("legend", {}, title), ...Object.entries(options).map(([value, text]) => {
    const input = element("input", { type: "radio", name, value, onchange: () => change(value) });
    input.checked = value === chosen;
    return element("label", {}, input, " ", text);
  }));
}

function tick(text, on, change) {
  const input = element("input", { type: "checkbox", onchange: () => change(input.checked) });
  input.checked = on;
  return element("label", {}, input, " ", text);
}

// Brings a tick into a state, as a click does.
function setTick(box, on) {
  const input = box.querySelector("input");
  if (input.checked !== on) input.click();
}
