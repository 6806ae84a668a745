// What is said of a cup that was picked, or of what is no cup, and the slice through it.

function cupTable(cup) {
  const rows = [], add = (name, ...value) => value[0] !== "" && rows.push(element("tr", {}, element("td", {}, name), element("td", {}, ...value)));
  add("content", contentOf(cup).words);
  if (cup.p_liquid !== null) add("probability of a liquid", cup.p_liquid.toFixed(3));
  add("depth of the liquid", withSigma(cup.fill_mm, cup.fill_sigma_mm));
  add("level that is measured inside", withSigma(cup.surface_mm, cup.sigma_mm));
  add("bottom, taken to be at", withSigma(cup.bottom_mm, null));
  add("rim above the desk", withSigma(cup.height_mm, null));
  add("radius 45 mm above the desk", withSigma(cup.radius_mm, cup.radius_sigma_mm));
  if (cup.lean_deg !== null) add(`wall leans ${cup.lean_deg < 0 ? "inwards" : "outwards"} by`, `${oneDecimal(Math.abs(cup.lean_deg))}°`);
  const right = cup.at_m[0] * MM;
  add("axis from below the sensor", `${oneDecimal(Math.abs(right))} mm ${right < 0 ? "left" : "right"}, ${oneDecimal(cup.at_m[1] * MM)} mm away`);
  return element("table", {}, ...rows);
}

function candidateTable(candidate) {
  const rows = [["width", candidate.width_mm], ["height above the desk", candidate.height_mm], ["level that is measured inside", candidate.surface_mm]];
  return element("table", {}, ...rows.filter(([, value]) => value !== null).map(([name, value]) =>
    element("tr", {}, element("td", {}, name), element("td", {}, withSigma(value, null)))));
}

// Seen from the right, the sensor on the left.
function sliceOf(data, thing) {
  const HALF_WIDTH = 0.01, away = thing.at.clone().normalize(), half = thing.radius * 1.25 + 0.012, points = [];
  for (let i = 0; i < data.owners.length; ++i) {
    const p = place(data.points, i, data.step_m), from = p.clone().sub(thing.at);
    if (Math.abs(from.x * away.y - from.y * away.x) > HALF_WIDTH) continue;
    points.push({ u: from.x * away.x + from.y * away.y, z: p.z, colour: data.owners[i] === thing.owner ? thing.colour : "#c3c9d0" });
  }
  const walls = [], levels = [];
  if (thing.cup) {
    const cup = thing.cup, side = sign => [[sign * radiusAt(cup, 0), 0], [sign * radiusAt(cup, thing.height), thing.height]];
    walls.push(side(-1), side(1));
    const level = (z, text, colour, dashed) => {
      const reach = Math.max(radiusAt(cup, z) - 0.0015, 0.002);
      levels.push({ from: -reach, to: reach, z, colour, text, dashed });
    };
    if (cup.bottom_mm !== null) level(cup.bottom_mm / MM, `bottom, ${oneDecimal(cup.bottom_mm)} mm`, "#5b6570");
    if (surfaceOf(cup) !== null) level(surfaceOf(cup), `surface, ${oneDecimal(surfaceOf(cup) * MM)} mm`, thing.colour);
    if (cup.surface_mm !== null) level(cup.surface_mm / MM, `measured, ${oneDecimal(cup.surface_mm)} mm`, "#222222", true);
  }
  return sliceDrawing({ points, walls, levels, half, high: thing.height * 1.12 + 0.005, label: "A slice of 20 mm through the middle, from the side" });
}

function storyOf(data, thing) {
  const title = thing.cup ? `Cup ${thing.number}: ${contentOf(thing.cup).words}` : "No cup";
  const said = thing.cup ? thing.cup.why : thing.candidate.reason;
  return [
    element("div", {}, element("h2", {}, title), thing.cup ? cupTable(thing.cup) : candidateTable(thing.candidate),
            element("p", { class: "why" }, "The detector says: ", element("q", {}, said))),
    element("div", {}, element("h2", {}, "A slice of 20 mm through the middle, to scale"), sliceOf(data, thing))];
}
