// Bodies of revolution about an upright axis, and what lies level in them.

const glassy = (colour, opacity) => new THREE.MeshLambertMaterial({
  color: colour, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide });

// `profile`: pairs of radius and height.
function revolved(profile, at, material) {
  const geometry = new THREE.LatheBufferGeometry(profile.map(([radius, height]) => new THREE.Vector2(radius, height)), 64);
  geometry.rotateX(Math.PI / 2);
  geometry.computeVertexNormals();
  const body = new THREE.Mesh(geometry, material);
  body.position.set(at.x, at.y, 0);
  return body;
}

// A part of a ring, or a disc where the inner radius is 0, which three.js takes for none given; angles from x towards y.
function levelPart(at, inner, outer, height, material, from = 0, length = 2 * Math.PI) {
  const part = new THREE.Mesh(new THREE.RingBufferGeometry(Math.max(inner, 1e-6), outer, 64, 1, from, length), material);
  part.position.set(at.x, at.y, height);
  return part;
}

// Places along an arc, for Stage.line.
function arc(at, radius, height, from = 0, length = 2 * Math.PI) {
  return Array.from({ length: 73 }, (_, k) => {
    const angle = from + length * k / 72;
    return new THREE.Vector3(at.x + radius * Math.cos(angle), at.y + radius * Math.sin(angle), height);
  });
}
