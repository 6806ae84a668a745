"use strict";
// The script of the page of `fathom view`, first part: colours and units. All that bends was traced by the program; the
// script draws straight lines between the bends.

const COLOURS = { camera: "#0059a8", projector: "#d55e00", true: "#1c7c3c", apparent: "#8a1d8a", measured: "#222222",
                  liquid: "#3d9be0", cup: "#8a94a0", thing: "#b59b7a" };
const MM = 1000;
const mm = metres => (metres * MM).toFixed(1);

// Dark violet, blue, green, yellow: even in lightness, readable without red.
const HEIGHTS = ["#3b1c5a", "#3a5089", "#217f8d", "#35a86f", "#a3c83c", "#f0d433"].map(c => new THREE.Color(c));
// Blue nearer, grey none, red farther.
const SIGNS = ["#0b5fb0", "#6fb0e0", "#c9c9c9", "#ee9a70", "#c0261d"].map(c => new THREE.Color(c));

function colourOf(scale, share) {
  const at = Math.min(Math.max(share, 0), 1) * (scale.length - 1), k = Math.min(Math.floor(at), scale.length - 2);
  return scale[k].clone().lerp(scale[k + 1], at - k);
}

function colourings(scene) {
  let high = 0.02;
  for (const mesh of scene.meshes) for (let k = 2; k < mesh.vertices.length; k += 3) high = Math.max(high, mesh.vertices[k] * scene.step_m);
  high = Math.ceil(high * 50) / 50;
  const signed = (title, what, range) => ({
    title, scale: SIGNS, ends: [`−${range * MM} mm`, "0", `+${range * MM} mm`],
    share: i => 0.5 + 0.5 * scene.difference(i, what) / range });
  return {
    height: { title: "Height above the desk", scale: HEIGHTS, ends: ["0 mm", `${Math.round(high * MM)} mm`],
              share: (i, kind) => scene.point(i, kind).z / high },
    error: signed("The device's own error: measured minus apparent depth", "error", 0.005),
    refraction: signed("What refraction does: apparent minus true depth", "refraction", 0.02) };
}
