// Numbers as the program packed them.

const ARRAYS = { u8: Uint8Array, u16: Uint16Array, i16: Int16Array, u32: Uint32Array };

async function unpack(block) {
  const bytes = Uint8Array.from(atob(block.deflate), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new ARRAYS[block.type](await new Response(stream).arrayBuffer());
}

async function unpackAll(value) {
  if (value === null || typeof value !== "object") return value;
  if (value.deflate) return unpack(value);
  const result = Array.isArray(value) ? [] : {};
  for (const key of Object.keys(value)) result[key] = await unpackAll(value[key]);
  return result;
}

const vector = a => new THREE.Vector3(a[0], a[1], a[2]);

// Places in whole steps, three numbers each.
function place(codes, i, step) { return new THREE.Vector3(codes[3 * i], codes[3 * i + 1], codes[3 * i + 2]).multiplyScalar(step); }
