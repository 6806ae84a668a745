// The picture that turns.

class Stage {
  // `across`: level, away from the sensor. What is cut open is cut across it.
  constructor(box, across) {
    this.box = box;
    this.across = across;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.localClippingEnabled = true;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The points in space. Arrow keys turn the picture, plus and minus bring it nearer.");
    box.append(this.canvas);
    this.world = new THREE.Scene();
    this.world.background = new THREE.Color("#f8f9fb");
    this.eye = new THREE.PerspectiveCamera(26, 1, 0.005, 50);
    this.eye.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.eye, this.canvas);
    this.controls.enableKeys = false;
    this.controls.minDistance = 0.02;
    this.controls.maxDistance = 12;
    this.controls.addEventListener("change", () => this.draw());
    this.cut = new THREE.Plane(this.across.clone(), 0);
    this.materials = { points: new THREE.PointsMaterial({ size: 0.0045, vertexColors: THREE.VertexColors }) };
    const disc = element("canvas", { width: 64, height: 64 }), brush = disc.getContext("2d");
    brush.fillStyle = "#ffffff";
    brush.arc(32, 32, 30, 0, 7);
    brush.fill();
    this.disc = new THREE.CanvasTexture(disc);
    this.lines = [];
    this.labels = [];
    this.world.add(new THREE.AmbientLight("#ffffff", 0.72));
    this.lamp = new THREE.DirectionalLight("#ffffff", 0.45);
    this.world.add(this.lamp);
    this.bodies = new THREE.Group();
    this.world.add(this.bodies);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(box);
    this.resize();
  }

  resize() {
    const width = this.box.clientWidth, height = this.box.clientHeight;
    this.renderer.setSize(width, height, false);
    this.eye.aspect = width / height;
    this.eye.updateProjectionMatrix();
    for (const line of this.lines) line.material.resolution.set(width, height);
    this.draw();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.lamp.position.copy(this.eye.position);
      this.renderer.render(this.world, this.eye);
      for (const label of this.labels) this.placeLabel(label);
    });
  }

  placeLabel({ node, at, dy, group, width }) {
    const p = at.clone().project(this.eye);
    const shown = (!group || group.visible) && p.z > -1 && p.z < 1 && Math.abs(p.x) < 1.05 && Math.abs(p.y) < 1.05;
    node.style.display = shown ? "" : "none";
    if (!shown) return;
    const room = this.box.clientWidth - width - 10;
    const x = Math.min((p.x + 1) / 2 * this.box.clientWidth, Math.max(room, 0)), y = (1 - p.y) / 2 * this.box.clientHeight + (dy || 0);
    node.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(6px, -50%)`;
  }

  label(text, at, kind = "", colour = "", dy = 0, group = null) {
    const node = element("span", { class: `label ${kind}` }, text);
    if (colour) node.style.color = colour;
    this.box.append(node);
    const label = { node, at: at.clone(), dy, group, width: kind ? node.offsetWidth : 0 };
    this.labels.push(label);
    return label;
  }

  line(places, colour, width, group, dash = 0) {
    const positions = [];
    for (let k = 0; k + 1 < places.length; ++k) positions.push(...places[k].toArray(), ...places[k + 1].toArray());
    const geometry = new THREE.LineSegmentsGeometry();
    geometry.setPositions(positions);
    const material = new THREE.LineMaterial({ color: new THREE.Color(colour).getHex(), linewidth: width });
    if (dash) {
      material.defines.USE_DASH = "";
      material.dashed = true;
      material.dashSize = dash;
      material.gapSize = 0.7 * dash;
    }
    material.resolution.set(this.box.clientWidth, this.box.clientHeight);
    const line = new THREE.LineSegments2(geometry, material);
    line.computeLineDistances();
    line.frustumCulled = false;
    group.add(line);
    this.lines.push(line);
    return line;
  }

  // A round mark of some pixels, in front of all.
  dot(at, colour, size, group) {
    const material = new THREE.PointsMaterial({
      color: colour, size, sizeAttenuation: false, map: this.disc, alphaTest: 0.5, depthTest: false, transparent: true });
    const mark = new THREE.Points(new THREE.BufferGeometry().setFromPoints([at]), material);
    mark.renderOrder = 5;
    group.add(mark);
  }

  // A grid on the desk around a place, and a scale that stands at its far corner: a line each `step` metres.
  addAxes(middle, reach = 0.15, tall = 0.15, step = 0.05) {
    const round = v => Math.round(v / step) * step, x0 = round(middle.x), y0 = round(middle.y), lines = [];
    for (let d = -reach; d < reach + step / 2; d += step) {
      lines.push(new THREE.Vector3(x0 + d, y0 - reach, 0), new THREE.Vector3(x0 + d, y0 + reach, 0));
      lines.push(new THREE.Vector3(x0 - reach, y0 + d, 0), new THREE.Vector3(x0 + reach, y0 + d, 0));
      this.label(`${Math.round((x0 + d) * MM)}`, new THREE.Vector3(x0 + d, y0 - reach, 0), "", "", 10);
      this.label(`${Math.round((y0 + d) * MM)}`, new THREE.Vector3(x0 + reach, y0 + d, 0));
    }
    this.label("x [mm]", new THREE.Vector3(x0, y0 - 1.2 * reach, 0), "", "", 10);
    this.label("y [mm]", new THREE.Vector3(x0 + 1.2 * reach, y0, 0));
    const corner = new THREE.Vector3(x0 - reach, y0 + reach, 0);
    lines.push(corner, corner.clone().setZ(tall));
    for (let z = 0; z < tall + step / 10; z += step / 5) {
      const long = Math.abs(z / step - Math.round(z / step)) < 1e-6, at = corner.clone().setZ(z);
      lines.push(at, at.clone().add(new THREE.Vector3((long ? -0.08 : -0.033) * reach, 0, 0)));
      if (long && z > 0) this.label(`${Math.round(z * MM)}`, at);
    }
    this.label("z [mm]", corner.clone().setZ(tall + 0.1 * reach));
    const geometry = new THREE.BufferGeometry().setFromPoints(lines);
    this.world.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: "#8d98a4" })));
  }

  // The sensor, or a part of it.
  addBox(at, colour, text) {
    const box = new THREE.Mesh(new THREE.BoxBufferGeometry(0.02, 0.02, 0.02), new THREE.MeshLambertMaterial({ color: colour }));
    box.position.copy(at);
    this.world.add(box);
    this.label(text, at, "mark", colour, -16);
  }

  // Removes what a group holds, and its labels.
  empty(group) {
    for (const child of [...group.children]) {
      group.remove(child);
      child.geometry.dispose();
      this.lines = this.lines.filter(line => line !== child);
    }
    this.labels = this.labels.filter(label => label.group !== group || (label.node.remove(), false));
  }

  // Coordinates and colours, three numbers each, and what each point is picked as.
  setPoints(places, colours, ids) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    const before = this.points;
    this.points = new THREE.Points(geometry, this.materials.points);
    if (before) {
      this.points.visible = before.visible;
      this.world.remove(before);
      before.geometry.dispose();
    }
    this.points.frustumCulled = false;
    this.ids = ids;
    this.world.add(this.points);
    this.draw();
  }

  // A part of the picture: its points, its bodies or another group.
  show(part, on) {
    part.visible = on;
    this.draw();
  }

  // Shows all, or what lies behind a plane through a place, across the baseline.
  cutAt(place) {
    if (place) this.cut.setFromNormalAndCoplanarPoint(this.across, place.clone().addScaledVector(this.across, -0.0025));
    const planes = place ? [this.cut] : [];
    this.materials.points.clippingPlanes = planes;
    for (const body of this.bodies.children) body.material.clippingPlanes = planes;
    this.draw();
  }

  // A direction to look from: up, and to the right of the sensor's side.
  from(up, right) {
    return this.across.clone().negate().setZ(up).add(new THREE.Vector3(this.across.y, -this.across.x, 0).multiplyScalar(right));
  }

  look(from, at, distance) {
    const room = distance * Math.max(1, 1.25 / this.eye.aspect);  // on a narrow screen one stands farther off
    this.eye.position.copy(at).addScaledVector(from.clone().normalize(), room);
    this.controls.target.copy(at);
    this.controls.update();
    this.draw();
  }

  // What the point is picked as that is nearest to a place on the canvas, the foremost of those within some pixels.
  nearest(x, y) {
    const width = this.box.clientWidth, height = this.box.clientHeight, reach = 9, p = new THREE.Vector3();
    const places = this.points.geometry.attributes.position, clipped = this.materials.points.clippingPlanes || [];
    let best = null, least = Infinity;
    for (let k = 0; k < places.count; ++k) {
      p.fromBufferAttribute(places, k);
      if (clipped.some(plane => plane.distanceToPoint(p) < 0)) continue;
      const away = p.distanceTo(this.eye.position);
      p.project(this.eye);
      const off = Math.hypot((p.x + 1) / 2 * width - x, (1 - p.y) / 2 * height - y);
      if (off > reach || Math.abs(p.z) > 1) continue;
      const badness = away + 0.004 * off;
      if (badness < least) [best, least] = [this.ids[k], badness];
    }
    return best;
  }

  listen() {
    let down = null;
    const begin = event => { const t = event.touches ? event.touches[0] : event; down = [t.clientX, t.clientY]; };
    const end = event => {
      const t = event.changedTouches ? event.changedTouches[0] : event;
      if (!down || Math.hypot(t.clientX - down[0], t.clientY - down[1]) > 4) return;
      const box = this.canvas.getBoundingClientRect(), id = this.nearest(t.clientX - box.left, t.clientY - box.top);
      if (id !== null && this.onPick) this.onPick(id);
    };
    this.canvas.addEventListener("mousedown", begin);
    this.canvas.addEventListener("mouseup", end);
    this.canvas.addEventListener("touchstart", begin, { passive: true });
    this.canvas.addEventListener("touchend", end);
    this.canvas.addEventListener("keydown", event => {
      const turn = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      const nearer = { "+": 0.88, "=": 0.88, "-": 1.14 }[event.key];
      if (!turn && !nearer) return;
      event.preventDefault();
      const arm = new THREE.Spherical(), quaternion = new THREE.Quaternion().setFromUnitVectors(this.eye.up, new THREE.Vector3(0, 1, 0));
      arm.setFromVector3(this.eye.position.clone().sub(this.controls.target).applyQuaternion(quaternion));
      if (turn) {
        arm.theta += turn[0];
        arm.phi = Math.min(Math.max(arm.phi + turn[1], 0.01), Math.PI - 0.01);
      } else {
        arm.radius *= nearer;
      }
      const offset = new THREE.Vector3().setFromSpherical(arm).applyQuaternion(quaternion.clone().inverse());
      this.eye.position.copy(this.controls.target).add(offset);
      this.controls.update();
    });
  }
}
