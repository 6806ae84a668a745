// The capture's data: every pixel as the rest of the page asks for it; places in metres in the world.
class Scene {
  constructor(data) {
    Object.assign(this, data);
    this.columns = data.pixels.columns;
    this.rows = data.pixels.rows;
    this.count = this.columns * this.rows;
    this.camera = vector(data.sensor.camera);
    this.projector = vector(data.sensor.projector);
    [this.right, this.down, this.forward] = data.sensor.axes.map(vector);
    this.bentAt = new Map();
    let first = 0;
    data.pixels.bent.forEach((pixel, i) => {
      const camera = data.pixels.bend_counts[2 * i], projector = data.pixels.bend_counts[2 * i + 1];
      this.bentAt.set(pixel, { number: i, first, camera, projector });
      first += camera + projector;
    });
  }

  seesSomething(i) { return this.pixels.path[i] > 0; }
  truth(i) { return place(this.pixels.point, i, this.step_m); }
  bends(i, ray) {
    const bent = this.bentAt.get(i);
    if (!bent) return [];
    const first = bent.first + (ray === "camera" ? 0 : bent.camera);
    return Array.from({ length: bent[ray] }, (_, k) => place(this.pixels.bends, first + k, this.step_m));
  }
  depthOf(place) { return place.clone().sub(this.camera).dot(this.forward); }
  apparentDepth(i) { return this.pixels.apparent[i] * this.pixels.depth_step_m; }
  measuredDepth(i) { return this.pixels.measured[i] * this.pixels.depth_step_m; }
  // On the camera's straight ray, at the depth where the projector's straight ray crosses it in the image.
  apparent(i) {
    const towards = (this.bends(i, "camera")[0] || this.truth(i)).sub(this.camera);
    return this.camera.clone().addScaledVector(towards, this.apparentDepth(i) / towards.dot(this.forward));
  }
  // As the device makes points of depths, by what it takes for its own focal length.
  measured(i) {
    const stride = this.pixels.stride, z = this.measuredDepth(i), focal = this.sensor.believed_focal_px;
    const centre = this.sensor.believed_principal_px;
    const x = (this.column(i) * stride + 0.5 - centre[0]) / focal, y = (this.row(i) * stride + 0.5 - centre[1]) / focal;
    return this.camera.clone().addScaledVector(this.right, x * z).addScaledVector(this.down, y * z).addScaledVector(this.forward, z);
  }
  paperHeight(i) {
    const bent = this.bentAt.get(i), code = bent ? this.pixels.paper_height[bent.number] : -32768;
    return code === -32768 ? null : code * this.step_m;
  }
  disparity(depth) { return this.sensor.focal_baseline_m_px / depth; }
  column(i) { return i % this.columns; }
  row(i) { return Math.floor(i / this.columns); }
  object(number) { return this.objects[number - 1]; }

  has(i, kind) {
    if (kind === "measured") return this.pixels.measured[i] > 0;
    return this.seesSomething(i) && (kind === "true" || this.pixels.apparent[i] > 0);
  }
  point(i, kind) { return kind === "measured" ? this.measured(i) : kind === "true" ? this.truth(i) : this.apparent(i); }
  // [m], NaN where one of the two is not there
  difference(i, what) {
    if (!this.seesSomething(i) || !this.pixels.apparent[i]) return NaN;
    if (what === "refraction") return this.apparentDepth(i) - this.depthOf(this.truth(i));
    return this.pixels.measured[i] ? this.measuredDepth(i) - this.apparentDepth(i) : NaN;
  }

  // A pixel that shows refraction best: on the bottom under a liquid, in the middle of what is seen of it, and measured as
  // most of its neighbours are.
  telling() {
    const seen = [...this.bentAt.keys()].filter(i => this.pixels.path[i] === 2 && this.pixels.apparent[i] && this.pixels.measured[i]);
    if (!seen.length) return Math.floor(this.rows / 2) * this.columns + Math.floor(this.columns / 2);
    const height = i => this.pixels.point[3 * i + 2] * this.step_m;
    const lowest = seen.reduce((least, i) => Math.min(least, height(i)), Infinity);
    const bottom = seen.filter(i => height(i) < lowest + 0.001).map(i => ({ i, at: this.truth(i), error: this.difference(i, "error") }));
    const middle = bottom.reduce((sum, { at }) => sum.add(at), new THREE.Vector3()).divideScalar(bottom.length);
    const usual = bottom.map(({ error }) => error).sort((a, b) => a - b)[Math.floor(bottom.length / 2)];
    // The fewer bends, the plainer; glass has many.
    const badness = ({ i, at, error }) =>
      at.distanceTo(middle) + 5 * Math.abs(error - usual) + 0.02 * (this.bentAt.get(i).camera + this.bentAt.get(i).projector);
    return bottom.reduce((best, each) => badness(each) < badness(best) ? each : best).i;
  }
  aim() {
    if (this.focus) return vector(this.focus);
    const middle = Math.floor(this.rows / 2) * this.columns + Math.floor(this.columns / 2);
    return this.seesSomething(middle) ? this.truth(middle) : this.camera.clone().addScaledVector(this.forward, 1.0);
  }
}
