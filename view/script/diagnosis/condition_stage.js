// The picture of one condition: the cup, the points of its cloud, and where the model has what is seen in it.

const MODELS = { before: "#D55E00", after: "#0072B2" };
// Parts of the cup as heights are taken in them: from and to in radii, then where they begin and how far they go.
const PARTS = { centre: [0, 0.5, 0, 2], near: [0.5, 1, 1.25, 0.5], far: [0.5, 1, 0.25, 0.5], left: [0.5, 1, 0.75, 0.5], right: [0.5, 1, 1.75, 0.5],
                interior: [0, 1, 0, 2] };

// The part of the cup in which a point lies, from the axis; nothing beyond the radius in which heights are taken.
function partOf(x, y, within) {
  const radius = Math.hypot(x, y);
  if (radius >= within) return null;
  if (radius < within / 2) return "centre";
  return Math.abs(x) > Math.abs(y) ? (x > 0 ? "right" : "left") : (y > 0 ? "far" : "near");
}

class ConditionStage extends Stage {
  constructor(data, box) {
    super(box, new THREE.Vector3(0, 1, 0));
    this.data = data;
    this.axis = new THREE.Vector3();
    this.addAxes(this.axis, 0.1, 0.1);
    for (const profile of [data.cup.outer, data.cup.inner]) {
      const wall = revolved(profile, this.axis, glassy(COLOURS.cup, 0.16));
      wall.renderOrder = 3;
      this.bodies.add(wall);
    }
    this.plates = new THREE.Group();
    this.marks = new THREE.Group();
    this.world.add(this.plates, this.marks);
  }

  height() { return this.data.cup.outer[this.data.cup.outer.length - 1][1]; }

  // `model`: "before" or "after". Points are coloured by how far they are from it, where `range` metres are the end of the scale.
  showCondition(condition, model, range) {
    this.empty(this.plates);
    this.empty(this.marks);
    const key = `${model}_mm`, within = this.data.within_m, levels = new Map(condition.regions.map(each => [each.region, each]));
    for (const { region, measured_mm, [key]: model_mm } of condition.regions) {
      const [from, to, begin, length] = PARTS[region], inner = from * within, outer = to * within;
      const plate = levelPart(this.axis, inner, outer, model_mm / MM, glassy(MODELS[model], 0.42), begin * Math.PI, length * Math.PI);
      plate.renderOrder = 4;
      this.plates.add(plate);
      this.line(arc(this.axis, outer, measured_mm / MM, begin * Math.PI, length * Math.PI), "#111111", 2.6, this.marks);
      if (from > 0) this.line(arc(this.axis, inner, measured_mm / MM, begin * Math.PI, length * Math.PI), "#111111", 1.4, this.marks);
    }
    this.nameLevels(condition, model);
    if (condition.fill_mm > 0) {
      const level = this.data.cup.inner[0][1] + condition.fill_mm / MM;
      this.line(arc(this.axis, this.innerRadius(level), level), COLOURS.liquid, 1.8, this.marks, 0.004);
    }
    this.showCloud(condition, levels, key, range);
  }

  nameLevels(condition, model) {
    const mean = key => condition.regions.reduce((sum, each) => sum + each[key], 0) / condition.regions.length;
    const side = this.data.within_m + 0.003;
    for (const [text, height, colour, dy] of [["measured", mean("measured_mm"), "#111111", -9], ["model", mean(`${model}_mm`), MODELS[model], 9]])
      this.label(`${text} ${height.toFixed(1)} mm`, new THREE.Vector3(side, 0, height / MM), "mark", colour, dy, this.marks);
  }

  // Of the inside, by its profile.
  innerRadius(height) {
    const profile = this.data.cup.inner;
    for (let k = 1; k < profile.length; ++k) {
      const [r0, z0] = profile[k - 1], [r1, z1] = profile[k];
      if (height <= z1 && z1 > z0) return r0 + (r1 - r0) * Math.max(height - z0, 0) / (z1 - z0);
    }
    return profile[profile.length - 1][0];
  }

  showCloud(condition, levels, key, range) {
    const places = [], colours = [], grey = new THREE.Color("#b4bcc5");
    for (const { p, part } of this.pointsOf(condition)) {
      const level = part && (levels.get(part) || levels.get("interior"));
      const c = level ? colourOf(SIGNS_ON_WHITE, 0.5 + 0.5 * (p.z - level[key] / MM) / range) : grey;
      places.push(p.x, p.y, p.z);
      colours.push(c.r, c.g, c.b);
    }
    this.setPoints(places, colours, []);
  }

  pointsOf(condition) {
    if (!condition.shot) return [];
    return Array.from({ length: condition.shot.points.length / 3 }, (_, i) => {
      const p = place(condition.shot.points, i, this.data.step_m);
      return { p, part: partOf(p.x, p.y, this.data.within_m) };
    });
  }
}
