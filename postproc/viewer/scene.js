// Reads the scene that scene.cpp packs: a header in JSON, then typed arrays.

/** The bytes behind a script element that holds deflated data as base64. */
async function inflated(id) {
  const text = document.getElementById(id).textContent.trim();
  const response = await fetch("data:application/octet-stream;base64," + text);
  return new Response(response.body.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

/** Undoes the separation into byte planes: byte k of all elements comes before byte k + 1. */
function joined(planes, count, size) {
  const bytes = new Uint8Array(count * size);
  for (let k = 0; k < size; ++k)
    for (let i = 0, from = k * count; i < count; ++i) bytes[i * size + k] = planes[from + i];
  return bytes.buffer;
}

/** Integers: zigzag code of the differences from the element `delta` places before. */
function decodedIntegers(buffer, delta) {
  const values = new Int32Array(buffer);
  for (let i = 0; i < values.length; ++i) values[i] = (values[i] >>> 1) ^ -(values[i] & 1);
  if (delta > 0)
    for (let i = delta; i < values.length; ++i) values[i] += values[i - delta];
  return values;
}

class Scene {
  constructor(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    this.header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    this.payload = new Uint8Array(buffer, 4 + length);
    this.cache = new Map();
  }

  has(name) { return name in this.header.arrays; }

  /** A typed array: Uint8Array, Int32Array, or Float64Array (also of quantised numbers). */
  get(name) {
    if (!this.cache.has(name)) this.cache.set(name, this.decode(this.header.arrays[name], name));
    return this.cache.get(name);
  }

  decode(array, name) {
    if (!array) throw new Error("the scene has no array " + name);
    const sizes = {u8: 1, i32: 4, f32: 4, f64: 8};
    const size = sizes[array.type];
    const planes = this.payload.subarray(array.start, array.start + array.count * size);
    if (array.type === "u8") return planes;
    const buffer = joined(planes, array.count, size);
    if (array.type === "f64") return new Float64Array(buffer);
    if (array.type === "f32") return Float64Array.from(new Float32Array(buffer));
    const integers = decodedIntegers(buffer, array.delta);
    if (!array.step) return integers;
    const numbers = new Float64Array(array.count), origin = array.origin || [0, 0, 0];
    for (let i = 0; i < numbers.length; ++i) numbers[i] = origin[i % 3] + integers[i] * array.step;
    return numbers;
  }
}

/** The starts of consecutive ranges with the given sizes, with the end of the last. */
function startsOf(sizes) {
  const starts = new Int32Array(sizes.length + 1);
  for (let i = 0; i < sizes.length; ++i) starts[i + 1] = starts[i] + sizes[i];
  return starts;
}
