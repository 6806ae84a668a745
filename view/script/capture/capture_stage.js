// The picture of a capture: its bodies, its sensor, its points and the rays of a pixel.

class CaptureStage extends Stage {
  constructor(scene, box) {
    // Across the baseline: who looks along it sees the two rays cross.
    const across = scene.forward.clone().addScaledVector(scene.right, -scene.forward.dot(scene.right)).setZ(0);
    if (across.length() < 0.05) across.set(-scene.right.y, scene.right.x, 0);
    super(box, across.normalize());
    this.scene = scene;
    this.addMeshes();
    this.addAxes(scene.aim());
    this.addBox(scene.camera, COLOURS.camera, "infrared camera");
    this.addBox(scene.projector, COLOURS.projector, "projector");
    this.line([scene.camera, scene.projector], "#555555", 3, this.world);
    this.rays = new THREE.Group();
    this.world.add(this.rays);
  }

  addMeshes() {
    for (const mesh of this.scene.meshes) {
      const kind = this.scene.object(mesh.object).kind, geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(mesh.vertices, v => v * this.scene.step_m), 3));
      geometry.setIndex(new THREE.BufferAttribute(mesh.corners, 1));
      geometry.computeVertexNormals();
      const material = new THREE.MeshLambertMaterial({
        color: COLOURS[kind], transparent: true, opacity: kind === "liquid" ? 0.34 : 0.14, depthWrite: false, side: THREE.DoubleSide });
      const body = new THREE.Mesh(geometry, material);
      body.renderOrder = kind === "liquid" ? 3 : 2;
      this.bodies.add(body);
    }
  }

  // Points of a kind, coloured; pixels without one are left out.
  showPoints(kind, colouring) {
    const places = [], colours = [], pixels = [];
    for (let i = 0; i < this.scene.count; ++i) {
      if (!this.scene.has(i, kind)) continue;
      const share = colouring.share(i, kind);
      if (Number.isNaN(share)) continue;
      const p = this.scene.point(i, kind), c = colourOf(colouring.scale, share);
      places.push(p.x, p.y, p.z);
      colours.push(c.r, c.g, c.b);
      pixels.push(i);
    }
    this.setPoints(places, colours, pixels);
  }

  showRays(pixel) {
    this.empty(this.rays);
    const scene = this.scene;
    const mark = (place, kind, text) => {
      this.dot(place, COLOURS[kind], 11, this.rays);
      this.label(text, place, "mark", COLOURS[kind], 0, this.rays);
    };
    if (scene.seesSomething(pixel)) {
      const truth = scene.truth(pixel), bends = scene.bends(pixel, "camera"), lit = scene.has(pixel, "apparent");
      this.line([scene.camera, ...bends, truth], COLOURS.camera, 3, this.rays);
      if (lit) {
        const others = scene.bends(pixel, "projector"), apparent = scene.apparent(pixel);
        this.line([scene.projector, ...others, truth], COLOURS.projector, 3, this.rays);
        if (bends.length) this.line([bends[0], apparent], COLOURS.camera, 1.6, this.rays, 0.0016);
        if (others.length) {
          const out = others[0].clone().sub(scene.projector);
          const end = scene.projector.clone().addScaledVector(out, scene.apparentDepth(pixel) / out.dot(scene.forward));
          this.line([others[0], end], COLOURS.projector, 1.6, this.rays, 0.0016);
        }
        if (bends.length || others.length) mark(apparent, "apparent", "straight rays meet");
      }
      mark(truth, "true", "really here");
    }
    if (scene.has(pixel, "measured")) this.dot(scene.measured(pixel), COLOURS.measured, 9, this.rays);
    this.draw();
  }
}
