// How a page begins: its data are unpacked, then it is built.

function wishes() { return new URLSearchParams(location.hash.slice(1)); }

// A wish counts where it is one of the choices.
const granted = (wish, choices, otherwise) => Object.prototype.hasOwnProperty.call(choices, wish) ? wish : otherwise;

// The address may choose what the panel's choices of these names are.
function grantChoices(panel, state, names) {
  for (const name of names) {
    const input = [...panel.querySelectorAll(`input[name=${name}]`)].find(each => each.value === wishes().get(name));
    if (!input) continue;
    input.checked = true;
    state[name] = input.value;
  }
}

async function start(build) {
  const page = document.getElementById("page");
  const fail = words => page.replaceChildren(element("p", {}, words));
  if (typeof DecompressionStream === "undefined") return fail("This browser is too old for this page: it needs one of 2023 or later.");
  try {
    build(await unpackAll(JSON.parse(document.getElementById("data").textContent)), page);
    document.documentElement.dataset.state = "ready";
  } catch (problem) {
    document.documentElement.dataset.state = "failed";
    fail(`The page cannot be drawn: ${problem.message}. It needs WebGL.`);
  }
}
