// A slice through a cup from the side, to scale: the points in it, its walls, and levels with their names.

// All in metres: `points` {u, z, colour}, `walls` lists of [u, z], `levels` {from, to, z, colour, text, dashed}.
function sliceDrawing({ points, walls, levels, half: wanted, high, label }) {
  const width = 480, left = 40, right = 150, top = 12, bottom = 40, low = -0.006;
  const scale = Math.min((width - left - right) / (2 * wanted), 380 / (high - low)), height = top + bottom + (high - low) * scale;
  const half = (width - left - right) / 2 / scale;
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${height.toFixed(1)}`, role: "img", "aria-label": label });
  const x = u => left + (u + half) * scale, y = z => top + (high - z) * scale;
  const add = (tag, attributes, ...children) => svg.append(drawn(tag, attributes, ...children));
  const grey = { fill: "#5b6570" };
  const step = [0.01, 0.02, 0.05].find(each => each * scale > 30) || 0.1;
  for (let z = 0; z < high; z += step) {
    add("line", { x1: left, x2: width - right, y1: y(z), y2: y(z), stroke: z === 0 ? "#9aa3ad" : "#e8ebee" });
    add("text", { x: left - 6, y: y(z) + 4, "text-anchor": "end", ...grey }, `${Math.round(z * MM)}`);
  }
  for (let u = -Math.floor(half / step) * step; u <= half; u += step)
    add("text", { x: x(u), y: height - bottom + 16, "text-anchor": "middle", ...grey }, `${Math.round(u * MM)}`);
  add("text", { x: left, y: height - 6, ...grey }, "away from the sensor, from the axis [mm]");

  const byColour = new Map();
  for (const { u, z, colour } of points) {
    if (Math.abs(u) > half || z < low || z > high) continue;
    byColour.set(colour, `${byColour.get(colour) || ""}M${x(u).toFixed(1)} ${y(z).toFixed(1)}h0`);
  }
  for (const [colour, d] of byColour) add("path", { d, stroke: colour, "stroke-width": 3, "stroke-linecap": "round", fill: "none" });
  for (const wall of walls)
    add("polyline", { points: wall.map(([u, z]) => `${x(u).toFixed(1)},${y(z).toFixed(1)}`).join(" "), fill: "none", stroke: "#5b6570", "stroke-width": 1.6 });
  // Names one below the other, each with a line to its level.
  const named = levels.filter(level => level.text).sort((a, b) => b.z - a.z);
  let free = -Infinity;
  const placed = named.map(level => free = Math.max(free + 15, y(level.z) + 4));
  const over = Math.max(0, (placed[placed.length - 1] || 0) - (height - bottom));
  for (const { from, to, z, colour, dashed } of levels)
    add("line", { x1: x(from), x2: x(to), y1: y(z), y2: y(z), stroke: colour, "stroke-width": 2.6, ...(dashed ? { "stroke-dasharray": "5 4" } : {}) });
  named.forEach(({ to, z, colour, text }, k) => {
    const py = placed[k] - over;
    add("path", { d: `M${x(to).toFixed(1)} ${y(z).toFixed(1)}L${width - right + 2} ${(py - 4).toFixed(1)}`, stroke: colour, "stroke-width": 0.8, fill: "none" });
    add("text", { x: width - right + 6, y: py, fill: colour, "font-weight": 600 }, text);
  });
  return svg;
}
