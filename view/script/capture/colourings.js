// The page of a capture: how its points are coloured. All that bends was traced by the program; the script draws straight
// lines between the bends.

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
