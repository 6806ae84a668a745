// What is said of a condition: the heights by part of the cup, and a slice along the line of sight.

// "+1.2"; what is rounded to nothing has no sign.
function signed(number) {
  const size = Math.abs(number).toFixed(1);
  return `${size === "0.0" ? "" : number < 0 ? "−" : "+"}${size}`;
}


function heightsTable(condition) {
  const head = ["part of the cup", "measured [mm]", "model before [mm]", "model after [mm]", "measured − model before", "after, ± 1 σ"];
  const row = ({ region, measured_mm, before_mm, after_mm, sigma_mm }) => element("tr", {}, element("td", {}, region),
    element("td", {}, measured_mm.toFixed(1)), element("td", {}, word("before", before_mm.toFixed(1))), element("td", {}, word("after", after_mm.toFixed(1))),
    element("td", {}, signed(measured_mm - before_mm)), element("td", {}, `${signed(measured_mm - after_mm)} ± ${sigma_mm.toFixed(1)}`));
  return element("table", { class: "data" }, element("tr", {}, ...head.map(text => element("th", {}, text))), ...condition.regions.map(row));
}

// Points within 10 mm of the plane that goes through the axis, away from the sensor, and the levels of the parts that it cuts.
function sightSlice(stage, data, condition) {
  const outer = data.cup.outer, inner = data.cup.inner, widest = Math.max(...outer.map(([r]) => r)), height = stage.height();
  const points = stage.pointsOf(condition).filter(({ p }) => Math.abs(p.x) < 0.01).map(({ p, part }) => ({ u: p.y, z: p.z, colour: part ? "#59636e" : "#c3c9d0" }));
  const side = (profile, sign) => profile.map(([r, z]) => [sign * r, z]);
  const cut = { near: [-1, -0.5], centre: [-0.5, 0.5], far: [0.5, 1], interior: [-1, 1] }, levels = [];
  for (const [key, name, colour] of [["before_mm", "model before", MODELS.before], ["after_mm", "model after", MODELS.after], ["measured_mm", "measured", "#111111"]]) {
    const parts = condition.regions.filter(({ region }) => cut[region]);
    parts.forEach((each, k) => levels.push({
      from: cut[each.region][0] * data.within_m, to: cut[each.region][1] * data.within_m, z: each[key] / MM, colour,
      text: k === parts.length - 1 ? `${name} ${each[key].toFixed(1)}` : "" }));
  }
  if (condition.fill_mm > 0) {
    const level = inner[0][1] + condition.fill_mm / MM, reach = stage.innerRadius(level);
    levels.push({ from: -reach, to: reach, z: level, colour: COLOURS.liquid, text: `written fill ${(level * MM).toFixed(1)}`, dashed: true });
  }
  return sliceDrawing({ points, walls: [side(outer, 1), side(outer, -1), side(inner, 1), side(inner, -1)], levels,
                        half: widest + 0.012, high: height + 0.012, label: "A slice of 20 mm through the axis, away from the sensor" });
}

function storyOf(stage, data, condition) {
  const [session, pour, placement] = condition.placement;
  const where = `session ${session}, pour ${pour}, placement ${placement}`;
  const seen = condition.shot ? `The points are those of frame ${condition.shot.frame}, the sensor's own bias taken off.` : "There is no cloud of it.";
  return [
    element("div", {}, element("h2", {}, condition.words),
            element("p", {}, `Shown: ${where}${condition.placements > 1 ? `, one of ${condition.placements} placements` : ""}. ${seen}`), heightsTable(condition)),
    element("div", {}, element("h2", {}, "A slice of 20 mm, the sensor on the left, heights in mm"), sightSlice(stage, data, condition))];
}
