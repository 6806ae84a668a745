"use strict";
// The script of the pages of `fathom view`, what they share: colours and units.

const COLOURS = { camera: "#0059a8", projector: "#d55e00", true: "#1c7c3c", apparent: "#8a1d8a", measured: "#222222",
                  liquid: "#3d9be0", cup: "#8a94a0", thing: "#b59b7a" };
const MM = 1000;
const mm = metres => (metres * MM).toFixed(1);

// Dark violet, blue, green, yellow: even in lightness, readable without red.
const HEIGHTS = ["#3b1c5a", "#3a5089", "#217f8d", "#35a86f", "#a3c83c", "#f0d433"].map(c => new THREE.Color(c));
// Blue nearer, grey none, red farther.
const SIGNS = ["#0b5fb0", "#6fb0e0", "#c9c9c9", "#ee9a70", "#c0261d"].map(c => new THREE.Color(c));
// The same about white, for points that lie in a coloured level.
const SIGNS_ON_WHITE = ["#0b4f95", "#6fb0e0", "#ffffff", "#f0a57a", "#a81a14"].map(c => new THREE.Color(c));

function colourOf(scale, share) {
  const at = Math.min(Math.max(share, 0), 1) * (scale.length - 1), k = Math.min(Math.floor(at), scale.length - 2);
  return scale[k].clone().lerp(scale[k + 1], at - k);
}

function legend(colouring) {
  const steps = Array.from({ length: 13 }, (_, k) => `#${colourOf(colouring.scale, k / 12).getHexString()}`);
  return [colouring.title, element("div", { class: "bar", style: `background: linear-gradient(to right, ${steps.join(", ")})` }),
          element("div", { class: "ends" }, ...colouring.ends.map(text => element("span", {}, text)))];
}
