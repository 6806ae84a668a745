// What is said of a pixel, and the drawing of its two rays.

const nameOf = object => object.name.replace(/^(cup|object) (\d+) /, "");

function sentences(scene, pixel) {
  const said = [], say = (...parts) => said.push(element("li", {}, ...parts));
  const place = `The pixel in column ${scene.column(pixel) * scene.pixels.stride}, row ${scene.row(pixel) * scene.pixels.stride}`;
  if (!scene.seesSomething(pixel)) {
    say(`${place} sees nothing: its ray leaves the scene.`);
    return said;
  }
  const truth = scene.truth(pixel), object = scene.object(scene.pixels.object[pixel]);
  const cameraBends = scene.bends(pixel, "camera"), projectorBends = scene.bends(pixel, "projector");
  const bends = cameraBends.length + projectorBends.length, lit = scene.has(pixel, "apparent");
  const scattered = scene.pixels.path[pixel] === 3;
  say(`${place} sees “${nameOf(object)}”. The point is `, word("true", `really ${mm(truth.z)} mm`), " above the desk.");
  if (scattered) say("This liquid scatters light. The point is where the ray enters it; in images of full light the dots come back from below.");
  if (!lit) {
    say("The ", word("projector", "projector"), "'s light does not get there, so the device has nothing to compare.");
    return said;
  }
  const apparent = scene.apparent(pixel), raised = apparent.z - truth.z;
  if (bends) {
    const times = n => n === 1 ? "once" : n === 0 ? "not at all" : n === 2 ? "twice" : `${n} times`;
    const liquid = scene.objects.find(o => o.kind === "liquid" && o.level_m !== undefined &&
                                           cameraBends.concat(projectorBends).some(b => Math.abs(b.z - o.level_m) < 2e-3));
    const where = liquid && bends === 2 ? `at the surface of “${nameOf(liquid)}” (${mm(liquid.level_m)} mm, refractive index ${liquid.index.toFixed(3)})`
                                        : "where they enter or leave a clear body, or are mirrored within it";
    if (cameraBends.length === projectorBends.length)
      say("The ", word("camera", "camera's ray"), " and the ", word("projector", "projector's ray"), ` bend ${where}: each ${times(cameraBends.length)} on its way.`);
    else
      say("The ", word("camera", "camera's ray"), ` bends ${times(cameraBends.length)}, the `, word("projector", "projector's ray"), ` ${times(projectorBends.length)}, ${where}.`);
    const moved = Math.abs(raised) < 5e-5 ? "almost where the point is" :
      `${mm(Math.abs(raised))} mm too ${raised > 0 ? "high" : "low"}`;
    say("The device does not know this. It prolongs both rays straight (dashed), and these ",
        word("apparent", `meet ${mm(apparent.z)} mm`), ` above the desk: ${moved}.`);
    const paper = scene.paperHeight(pixel);
    if (paper !== null) say(`The paper's closed formula (Eq. 7) says ${mm(paper)} mm.`);
  } else {
    say("Both rays are straight, and they meet where the point is.");
  }
  if (scene.has(pixel, "measured")) {
    const error = scene.measuredDepth(pixel) - scene.apparentDepth(pixel);
    say("The device ", word("measured", `measured ${mm(scene.measured(pixel).z)} mm`),
        `: its depth is ${mm(Math.abs(error))} mm too ${error > 0 ? "far" : "near"} for rays that are straight. ` +
        (scene.infrared ? "That is its own error. It compares blocks of the image with a few dots in each, in steps of 1/8 pixel, and a unit has a smooth bias over the image."
                        : "This capture was made without images; what is left are the steps of its depths and the noise that was asked for."));
  } else {
    say("The device measured nothing here: the dots were too faint, or no block of the image fitted.");
  }
  return said;
}

function numbersTable(scene, pixel) {
  const rows = [], add = (kind, name, height, depth) =>
    rows.push(element("tr", {}, element("td", {}, word(kind, name)), element("td", {}, mm(height)), element("td", {}, depth === null ? "" : mm(depth)),
                      element("td", {}, depth === null ? "" : scene.disparity(depth).toFixed(2))));
  if (scene.seesSomething(pixel)) add("true", "true", scene.truth(pixel).z, scene.depthOf(scene.truth(pixel)));
  if (scene.has(pixel, "apparent")) add("apparent", "straight rays meet", scene.apparent(pixel).z, scene.apparentDepth(pixel));
  const paper = scene.paperHeight(pixel);
  if (paper !== null) add("small", "the paper's Eq. 7", paper, null);
  if (scene.has(pixel, "measured")) add("measured", "measured", scene.measured(pixel).z, scene.measuredDepth(pixel));
  const head = ["", "height [mm]", "depth [mm]", "disparity [px]"].map(text => element("th", {}, text));
  return element("table", { class: "data" }, element("tr", {}, ...head), ...rows);
}

// The two rays near the point, from the side: heights against the place along the baseline, which is stretched.
function closeUp(scene, pixel) {
  const width = 480, height = 400, left = 40, right = 14, top = 46, bottom = 40;
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "The two rays near the point, from the side, stretched along the baseline" });
  if (!scene.has(pixel, "apparent")) return svg;
  const truth = scene.truth(pixel), apparent = scene.apparent(pixel);
  const rays = { camera: [scene.camera, ...scene.bends(pixel, "camera")], projector: [scene.projector, ...scene.bends(pixel, "projector")] };
  const bends = rays.camera.slice(1).concat(rays.projector.slice(1));
  const heights = [truth.z, apparent.z, ...bends.map(b => b.z)];
  if (scene.has(pixel, "measured")) heights.push(scene.measured(pixel).z);
  const span = Math.max(Math.max(...heights) - Math.min(...heights), 0.02);
  const low = Math.min(...heights) - 0.14 * span, high = Math.max(...heights) + 0.3 * span;
  const along = p => p.clone().sub(truth).dot(scene.right);
  // Where a ray's first straight piece is at that height.
  const at = (ray, z) => {
    const next = ray[1] || truth, share = (z - ray[0].z) / (next.z - ray[0].z);
    return ray[0].clone().lerp(next, share);
  };
  const tops = Object.values(rays).map(ray => along(at(ray, high)));
  const places = [0, along(apparent), ...bends.map(along), ...tops];
  const middle = (Math.max(...places) + Math.min(...places)) / 2, reach = Math.max((Math.max(...places) - Math.min(...places)) * 0.9, 0.002);
  const x = v => left + (v - middle + reach) / (2 * reach) * (width - left - right);
  const y = z => top + (high - z) / (high - low) * (height - top - bottom);
  const stretch = ((width - left - right) / (2 * reach)) / ((height - top - bottom) / (high - low));
  const line = (a, b, attributes) => svg.append(drawn("line", { x1: x(along(a)), y1: y(a.z), x2: x(along(b)), y2: y(b.z), ...attributes }));
  const text = (px, py, said, attributes = {}) => svg.append(drawn("text", { x: px, y: py, ...attributes }, said));
  // Bold words that stay within the picture.
  const words = (px, py, said, attributes) => {
    const long = 7.3 * said.length, starts = attributes["text-anchor"] === "end" ? px - long : px;
    const first = Math.min(Math.max(starts, left + 4), width - right - long);
    text(first, py, said, { ...attributes, "text-anchor": "start", "font-weight": 600 });
  };

  const step = span > 0.12 ? 0.02 : span > 0.05 ? 0.01 : 0.005;
  for (let z = Math.ceil(low / step) * step; z < high; z += step) {
    svg.append(drawn("line", { x1: left, x2: width - right, y1: y(z), y2: y(z), stroke: "#e8ebee" }));
    text(left - 6, y(z) + 4, `${Math.round(z * MM)}`, { "text-anchor": "end", fill: "#5b6570" });
  }
  text(4, 14, "height above the desk [mm]", { fill: "#5b6570" });
  const across = [0.5, 1, 2, 5, 10, 20, 50].find(v => v * 8 > 2 * reach * MM) || 100;
  for (let v = Math.ceil((middle - reach) * MM / across) * across; v <= (middle + reach) * MM; v += across) {
    svg.append(drawn("line", { x1: x(v / MM), x2: x(v / MM), y1: height - bottom, y2: height - bottom + 4, stroke: "#9aa3ad" }));
    text(x(v / MM), height - bottom + 16, `${Number(v.toFixed(1))}`, { "text-anchor": "middle", fill: "#5b6570" });
  }
  svg.append(drawn("line", { x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, stroke: "#9aa3ad" }));
  text(width - right, height - 6, `along the baseline, from the point [mm], stretched ${stretch.toFixed(stretch < 10 ? 1 : 0)} times`, { "text-anchor": "end", fill: "#5b6570" });

  for (const liquid of scene.objects.filter(o => o.level_m !== undefined && bends.some(b => Math.abs(b.z - o.level_m) < 2e-3))) {
    const level = y(liquid.level_m);
    svg.prepend(drawn("rect", { x: left, width: width - left - right, y: level, height: Math.max(y(truth.z) - level, 0), fill: "#d9ecfa" }));
    text(left + 4, level - 5, `surface of ${nameOf(liquid)}`, { fill: "#2b7bb9" });
  }

  svg.append(drawn("line", { x1: left, x2: width - right, y1: y(truth.z), y2: y(truth.z), stroke: "#8a94a0", "stroke-width": 2 }));
  for (const [name, ray] of Object.entries(rays)) {
    const way = [at(ray, high), ...ray.slice(1), truth], look = { stroke: COLOURS[name], "stroke-width": 2.4 };
    for (let k = 0; k + 1 < way.length; ++k) line(way[k], way[k + 1], look);
    if (ray.length > 1) {
      const out = ray[1].clone().sub(ray[0]);
      const end = ray[0].clone().addScaledVector(out, scene.apparentDepth(pixel) / out.dot(scene.forward));
      line(ray[1], end, { ...look, "stroke-width": 1.6, "stroke-dasharray": "6 4" });
    }
    const start = x(along(at(ray, high)));
    words(start, top - 8, `to the ${name}`, { fill: COLOURS[name], "text-anchor": start < width / 2 ? "end" : "start" });
  }
  const taken = [];
  const mark = (p, kind, said) => {
    svg.append(drawn("circle", { cx: x(along(p)), cy: y(p.z), r: 5, fill: COLOURS[kind], stroke: "#fff", "stroke-width": 1.5 }));
    let py = y(p.z) + (kind === "true" ? 17 : 4);  // below the line of what is really there
    while (taken.some(other => Math.abs(other - py) < 14)) py += 2;
    taken.push(py);
    words(x(Math.max(0, along(p))) + 40, py, said, { fill: COLOURS[kind] });
  };
  if (bends.length) mark(apparent, "apparent", `straight rays meet: ${mm(apparent.z)} mm`);
  if (scene.has(pixel, "measured")) mark(scene.measured(pixel), "measured", `measured: ${mm(scene.measured(pixel).z)} mm`);
  mark(truth, "true", `really: ${mm(truth.z)} mm`);
  return svg;
}
