// The page, put together.

function legend(colouring) {
  const steps = Array.from({ length: 13 }, (_, k) => `#${colourOf(colouring.scale, k / 12).getHexString()}`);
  return [colouring.title, element("div", { class: "bar", style: `background: linear-gradient(to right, ${steps.join(", ")})` }),
          element("div", { class: "ends" }, ...colouring.ends.map(text => element("span", {}, text)))];
}

function build(scene, page) {
  const stageBox = element("div", { id: "stage" }), legendBox = element("div", { id: "legend" });
  const panel = element("div"), story = element("section", { id: "story", "aria-live": "polite" });
  page.replaceChildren(element("div", {}, stageBox), panel, story);
  const stage = new Stage(scene, stageBox), colours = colourings(scene);
  stageBox.append(legendBox);
  const state = { kind: "measured", colouring: "height", cut: false, pixel: scene.telling() };

  const paint = () => {
    const colouring = colours[state.colouring];
    stage.showPoints(state.kind, colouring);
    map.paint(state.kind, colouring);
    legendBox.replaceChildren(...legend(colouring));
  };
  const cut = () => stage.cutAt(state.cut ? (scene.seesSomething(state.pixel) ? scene.truth(state.pixel) : scene.aim()) : null);
  const pick = pixel => {
    state.pixel = pixel;
    stage.showRays(pixel);
    map.mark(pixel);
    column.value = scene.column(pixel) * scene.pixels.stride;
    row.value = scene.row(pixel) * scene.pixels.stride;
    story.replaceChildren(
      element("div", {}, element("h2", {}, "What happens at this pixel"), element("ol", {}, ...sentences(scene, pixel)), numbersTable(scene, pixel)),
      element("div", {}, element("h2", {}, "The two rays, close to the point"), closeUp(scene, pixel)));
    if (state.cut) cut();
    document.documentElement.dataset.pixel = `${column.value},${row.value}`;
  };
  const pickAt = (x, y) => {
    const inside = (v, count) => Math.min(Math.max(Math.round(v), 0), count - 1);
    pick(inside(y, scene.rows) * scene.columns + inside(x, scene.columns));
  };
  const map = new PixelMap(scene, pickAt);
  const number = (name, most) => element("input", {
    type: "number", min: 0, max: most, "aria-label": name,
    onchange: () => pickAt(column.value / scene.pixels.stride, row.value / scene.pixels.stride) });
  const column = number("column", (scene.columns - 1) * scene.pixels.stride), row = number("row", (scene.rows - 1) * scene.pixels.stride);
  stage.onPick = pick;

  const aim = scene.aim(), low = aim.clone().setZ(0.5 * Math.max(aim.z, 0.09)), back = stage.across.clone().negate();
  const tilted = (up, side) => back.clone().setZ(up).addScaledVector(scene.right.clone().setZ(0).normalize(), side);
  const views = {
    "whole": () => stage.look(tilted(0.25, 0.9), aim.clone().lerp(scene.camera, 0.45), 2.0),
    "cup": () => stage.look(tilted(0.75, 0.55), low, 0.52),
    "side": () => { set("cut", true); stage.look(tilted(0.16, 0), low, 0.34); },
    "above": () => stage.look(new THREE.Vector3(0, 0, 1).addScaledVector(back, 0.01), low, 0.6),
    "rays": () => {
      set("cut", true);
      const truth = scene.truth(state.pixel);
      stage.look(tilted(0.04, 0), scene.has(state.pixel, "apparent") ? truth.lerp(scene.apparent(state.pixel), 0.5) : truth, 0.085);
    } };
  const boxes = {
    cut: tick("Cut open at the chosen pixel", false, on => { state.cut = on; cut(); }),
    bodies: tick("Cups and liquids", true, on => stage.showBodies(on)) };
  const set = (name, on) => {
    const input = boxes[name].querySelector("input");
    if (input.checked !== on) input.click();
  };
  const button = (text, view) => element("button", { type: "button", onclick: views[view] }, text);
  stageBox.after(element("div", { class: "buttons" }, button("Whole scene", "whole"), button("Cup", "cup"), button("From the side, cut open", "side"),
                         button("From above", "above"), button("The two rays", "rays")),
                 element("p", { class: "small" }, "Drag to turn, right drag or two fingers to move, wheel or pinch to come nearer, click or tap a point to choose its pixel. " +
                                                  "With the keyboard: arrow keys turn, + and − come nearer."));
  panel.append(
    choice("Points", "kind", { measured: "measured: where the device says they are", true: "true: where they really are",
                               apparent: "apparent: where straight rays meet; a device without errors measures this" }, state.kind,
           value => { state.kind = value; paint(); }),
    choice("Colour", "colouring", { height: "height above the desk", error: "the device's error", refraction: "what refraction does" }, state.colouring,
           value => { state.colouring = value; paint(); }),
    element("fieldset", {}, element("legend", {}, "Show"), boxes.cut, boxes.bodies),
    element("p", { id: "numbers" }, "Pixel: column ", column, " row ", row), map.canvas,
    element("p", { class: "small" }, "Click a pixel in the device's image. Arrow keys move it, with shift by ten."));
  if (scene.left_out.length)
    panel.append(element("p", { class: "small" }, `Drawn by their points alone, as their triangles are too many for a page: ${[...new Set(scene.left_out)].map(name => `“${name}”`).join(", ")}.`));

  // "#view=side&kind=apparent&colouring=error&pixel=320,240", each of them if wanted.
  const wish = new URLSearchParams(location.hash.slice(1));
  for (const name of ["kind", "colouring"]) {
    const input = [...panel.querySelectorAll(`input[name=${name}]`)].find(each => each.value === wish.get(name));
    if (input) {
      input.checked = true;
      state[name] = input.value;
    }
  }
  paint();
  const wanted = (wish.get("pixel") || "").split(",").map(Number);
  if (wanted.length === 2 && wanted.every(Number.isFinite)) pickAt(wanted[0] / scene.pixels.stride, wanted[1] / scene.pixels.stride);
  else pick(state.pixel);
  (Object.prototype.hasOwnProperty.call(views, wish.get("view")) ? views[wish.get("view")] : views.cup)();
}

(async () => {
  const page = document.getElementById("page");
  const fail = words => page.replaceChildren(element("p", {}, words));
  if (typeof DecompressionStream === "undefined") return fail("This browser is too old for this page: it needs one of 2023 or later.");
  try {
    build(new Scene(await unpackAll(JSON.parse(document.getElementById("data").textContent))), page);
    document.documentElement.dataset.state = "ready";
  } catch (problem) {
    document.documentElement.dataset.state = "failed";
    fail(`The page cannot be drawn: ${problem.message}. It needs WebGL.`);
  }
})();
