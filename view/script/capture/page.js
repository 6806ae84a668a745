// The page of a capture, put together.

function build(scene, page) {
  const { stage: stageBox, legend: legendBox, buttons, panel, story } = layout(page, "its pixel");
  const stage = new CaptureStage(scene, stageBox), colours = colourings(scene);
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

  const aim = scene.aim(), low = aim.clone().setZ(0.5 * Math.max(aim.z, 0.09));
  const views = {
    "whole": () => stage.look(stage.from(0.25, 0.9), aim.clone().lerp(scene.camera, 0.45), 2.0),
    "cup": () => stage.look(stage.from(0.75, 0.55), low, 0.52),
    "side": () => { setTick(boxes.cut, true); stage.look(stage.from(0.16, 0), low, 0.34); },
    "above": () => stage.look(stage.from(100, 0), low, 0.6),
    "rays": () => {
      setTick(boxes.cut, true);
      const truth = scene.truth(state.pixel);
      stage.look(stage.from(0.04, 0), scene.has(state.pixel, "apparent") ? truth.lerp(scene.apparent(state.pixel), 0.5) : truth, 0.085);
    } };
  const boxes = {
    cut: tick("Cut open at the chosen pixel", false, on => { state.cut = on; cut(); }),
    bodies: tick("Cups and liquids", true, on => stage.show(stage.bodies, on)) };
  buttons.append(button("Whole scene", views.whole), button("Cup", views.cup), button("From the side, cut open", views.side),
                 button("From above", views.above), button("The two rays", views.rays));
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
  const wish = wishes();
  grantChoices(panel, state, ["kind", "colouring"]);
  paint();
  const wanted = (wish.get("pixel") || "").split(",").map(Number);
  if (wanted.length === 2 && wanted.every(Number.isFinite)) pickAt(wanted[0] / scene.pixels.stride, wanted[1] / scene.pixels.stride);
  else pick(state.pixel);
  views[granted(wish.get("view"), views, "cup")]();
}

start((data, page) => build(new Scene(data), page));
