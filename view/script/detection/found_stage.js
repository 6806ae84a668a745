// The picture of a detection: every cup as its model, with the liquid in it, and outlines of what is no cup.

class FoundStage extends Stage {
  constructor(data, things, box) {
    const forward = vector(data.forward), across = forward.clone().setZ(0);
    super(box, across.length() > 0.05 ? across.normalize() : new THREE.Vector3(0, 1, 0));
    this.things = things;
    this.camera = vector(data.camera);
    this.models = new THREE.Group();
    this.outlines = new THREE.Group();
    this.world.add(this.models, this.outlines);
    const HUGE = 0.2;  // [m] a radius that no cup has: walls, people
    const shown = things.filter(({ cup, radius }) => cup || radius < HUGE);
    this.middle = shown.length ? shown.reduce((sum, { at }) => sum.add(at), new THREE.Vector3()).divideScalar(shown.length)
                               : this.camera.clone().addScaledVector(forward, data.desk ? this.camera.z / Math.max(-forward.z, 0.2) : 1.5);
    this.reach = shown.reduce((most, { at, radius }) => Math.max(most, at.distanceTo(this.middle) + radius + 0.06), 0.15);
    if (data.desk) {
      const step = this.reach > 0.3 ? 0.1 : 0.05;
      this.addAxes(this.middle, Math.ceil(this.reach / step) * step, 0.15, step);
    }
    this.addBox(this.camera, COLOURS.camera, "sensor");
    for (const thing of things) if (thing.cup) this.addCup(thing);
  }

  addCup(thing) {
    const { cup, at, height, colour } = thing, bottom = cup.bottom_mm === null ? null : cup.bottom_mm / MM, level = surfaceOf(cup);
    const WALL = 0.0015;  // [m] the radius lies between the inner and the outer wall
    const inside = z => Math.max(radiusAt(cup, z) - WALL, 0.001);
    thing.materials = [glassy(colour, 0.2)];
    const add = (body, order) => {
      body.renderOrder = order;
      this.bodies.add(body);
    };
    add(revolved([[radiusAt(cup, 0), 0], [radiusAt(cup, height), height]], at, thing.materials[0]), 3);
    if (bottom !== null) add(levelPart(at, 0, inside(bottom), bottom, glassy("#5b6570", 0.35)), 1);
    if (level !== null && bottom !== null && level > bottom) {
      thing.materials.push(glassy(colour, 0.16), glassy(colour, 0.5));
      add(revolved([[inside(bottom), bottom], [inside(level), level]], at, thing.materials[1]), 2);
      add(levelPart(at, 0, inside(level), level, thing.materials[2]), 2);
    }
  }

  // Points in the colours that each is given by; `colourOf(i)`.
  showPoints(data, colourOf) {
    const places = [], colours = [];
    for (let i = 0; i < data.owners.length; ++i) {
      const p = place(data.points, i, data.step_m), c = colourOf(i, p);
      places.push(p.x, p.y, p.z);
      colours.push(c.r, c.g, c.b);
    }
    this.setPoints(places, colours, data.owners);
  }

  // Outlines and names anew, so that what was picked stands out.
  pick(picked) {
    this.empty(this.models);
    this.empty(this.outlines);
    for (const thing of this.things) {
      const { at, height, colour } = thing, chosen = thing === picked;
      if (thing.candidate) {
        const outline = z => this.line(arc(at, thing.radius, z), chosen ? "#222222" : colour, chosen ? 2.6 : 1.1, this.outlines);
        [0.0005, height].forEach(outline);
        if (chosen) this.label(`no cup: ${thing.candidate.reason}`, at.clone().setZ(height), "mark", "", -10, this.outlines);
        continue;
      }
      const cup = thing.cup, rim = radiusAt(cup, height);
      this.line(arc(at, rim, height), chosen ? "#111111" : colour, chosen ? 4.5 : 3, this.models);
      this.line(arc(at, radiusAt(cup, 0), 0.0005), colour, chosen ? 2.4 : 1.4, this.models);
      if (cup.surface_mm !== null) {
        const seen = cup.surface_mm / MM;
        this.line(arc(at, radiusAt(cup, seen) - 0.01, seen), "#222222", 1.8, this.models, 0.004);
      }
      this.label(shortName(cup, thing.number), at.clone().setZ(height), `mark${chosen ? " chosen" : ""}`, colour, -14, this.models);
      thing.materials[0].opacity = chosen || !picked ? 0.24 : 0.12;
    }
    this.draw();
  }
}
