// Geometry: all blocks as one mesh, joints as one mesh, arrows and lines as rods.
// Every vertex belongs to a block or joint, whose vertices are consecutive.

const kBytes = 4;  // per vertex of a colour or an edge, of which three are used: browsers copy unaligned attributes at every draw
const kSharp = Math.cos(25 * Math.PI / 180);  // edges between flatter faces are seams of a block and are not drawn

/** Newell's normal of a polygon given by indices into flat coordinates. */
function polygonNormal(points, ids, from, to) {
  let x = 0, y = 0, z = 0;
  for (let i = from, j = to - 1; i < to; j = i++) {
    const a = 3 * ids[j], b = 3 * ids[i];
    x += (points[a + 1] - points[b + 1]) * (points[a + 2] + points[b + 2]);
    y += (points[a + 2] - points[b + 2]) * (points[a] + points[b]);
    z += (points[a] - points[b]) * (points[a + 1] + points[b + 1]);
  }
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}

/** The edges of one block: by key, the corners and whether the edge is drawn, as between faces at an angle. */
class BlockEdges {
  constructor() { this.edges = new Map(); }

  static key(a, b) { return a < b ? a * 4294967296 + b : b * 4294967296 + a; }

  add(a, b, normal) {
    const key = BlockEdges.key(a, b), known = this.edges.get(key);
    if (!known) { this.edges.set(key, {a, b, normal, sharp: true}); return; }
    const n = known.normal;
    known.sharp = n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2] < kSharp;
  }

  isSharp(a, b) { return this.edges.get(BlockEdges.key(a, b)).sharp; }
}

/** The faces of the scene and the blocks to which they belong. */
class BlockFaces {
  constructor(scene) {
    this.points = scene.get("vertices"), this.ids = scene.get("face_vertices"), this.inner = scene.get("face_inner");
    this.corner = startsOf(scene.get("face_sizes"));   // first corner of every face
    this.first = startsOf(scene.get("block_faces"));   // first face of every block
    this.blocks = this.first.length - 1;
  }

  edgesOf(block) {
    const edges = new BlockEdges();
    for (let f = this.first[block]; f < this.first[block + 1]; ++f) {
      const from = this.corner[f], to = this.corner[f + 1], normal = polygonNormal(this.points, this.ids, from, to);
      for (let c = from; c < to; ++c) edges.add(this.ids[c], this.ids[c + 1 < to ? c + 1 : from], normal);
    }
    return edges;
  }

  /** Flat coordinates of the ends of the drawn edges of a block. */
  outline(block) {
    const ends = [];
    for (const {a, b, sharp} of this.edgesOf(block).edges.values())
      if (sharp) for (const id of [a, b]) ends.push(this.points[3 * id], this.points[3 * id + 1], this.points[3 * id + 2]);
    return ends;
  }

  /** Triangles of all blocks, three vertices each, those of outer faces first. `edge`: per vertex, 255 or 0 for the distance
   * from each side of the triangle, 255 throughout where the side is not drawn. */
  triangles() {
    let count = 0;
    for (let f = 0; f + 1 < this.corner.length; ++f) count += Math.max(this.corner[f + 1] - this.corner[f] - 2, 0);
    const out = {rest: new Float32Array(9 * count), edge: new Uint8Array(3 * kBytes * count), blockOf: new Int32Array(count), used: 0,
                 start: new Int32Array(this.blocks + 1), outerEnd: new Int32Array(this.blocks)};
    for (let b = 0; b < this.blocks; ++b) {
      const edges = this.edgesOf(b);
      for (const inner of [0, 1]) {
        for (let f = this.first[b]; f < this.first[b + 1]; ++f) if (this.inner[f] === inner) this.addFace(f, edges, b, out);
        if (!inner) out.outerEnd[b] = 3 * out.used;
      }
      out.start[b + 1] = 3 * out.used;
    }
    return out;
  }

  addFace(f, edges, block, out) {
    const from = this.corner[f], to = this.corner[f + 1], ids = this.ids;
    for (let c = from + 2; c < to; ++c) {
      const corners = [ids[from], ids[c - 1], ids[c]], t = out.used++;
      const drawn = [edges.isSharp(corners[1], corners[2]),                       // opposite to corner 0
                     c + 1 === to && edges.isSharp(corners[2], corners[0]),
                     c === from + 2 && edges.isSharp(corners[0], corners[1])];
      out.blockOf[t] = block;
      for (let i = 0; i < 3; ++i)
        for (let k = 0; k < 3; ++k) {
          out.rest[9 * t + 3 * i + k] = this.points[3 * corners[i] + k];
          out.edge[kBytes * (3 * t + i) + k] = i === k || !drawn[k] ? 255 : 0;
        }
    }
  }
}

/** Joint patches as triangles. */
function jointGeometry(points, corners) {
  const start = startsOf(corners), jointOf = new Int32Array(start[corners.length]), triangles = [];
  for (let j = 0; j < corners.length; ++j)
    for (let v = start[j]; v < start[j + 1]; ++v) {
      jointOf[v] = j;
      if (v >= start[j] + 2) triangles.push(start[j], v - 1, v);
    }
  return {rest: Float32Array.from(points), jointOf, start, triangles: Uint32Array.from(triangles)};
}

// A rod along +z of length 1: three sides, and a pointed head if it is an arrow. x and y in units of the thickness; the
// third number is the place along the rod, the fourth is 1 on the head.
const kAround = [0, 1, 2].map((i) => [Math.cos(2.0944 * i), Math.sin(2.0944 * i)]);
function rodShape(arrow) {
  const shape = [], triangles = [];
  for (const end of [0, 1]) for (const [x, y] of kAround) shape.push([x, y, end, 0]);
  for (let i = 0; i < 3; ++i) {
    const n = (i + 1) % 3;
    triangles.push(i, n, n + 3, i, n + 3, i + 3);
  }
  if (arrow) {
    for (const [x, y] of kAround) shape.push([2.6 * x, 2.6 * y, 0, 1]);
    shape.push([0, 0, 1, 1]);
    triangles.push(6, 7, 9, 7, 8, 9, 8, 6, 9, 6, 8, 7);
  }
  return {shape, triangles};
}

/** Attributes of rods: `roots` and `spans` have three numbers, `colours` three bytes per rod. */
function rodGeometry(roots, spans, colours, arrow) {
  const {shape, triangles} = rodShape(arrow);
  const rods = roots.length / 3, per = shape.length;
  const root = new Float32Array(3 * rods * per), span = new Float32Array(3 * rods * per);
  const form = new Float32Array(4 * rods * per), colour = new Uint8Array(kBytes * rods * per);
  const index = new Uint32Array(rods * triangles.length);
  for (let r = 0, v = 0; r < rods; ++r) {
    triangles.forEach((t, i) => { index[r * triangles.length + i] = r * per + t; });
    for (const corner of shape) {
      for (let k = 0; k < 3; ++k)
        root[3 * v + k] = roots[3 * r + k], span[3 * v + k] = spans[3 * r + k], colour[kBytes * v + k] = colours[3 * r + k];
      form.set(corner, 4 * v++);
    }
  }
  return {root, span, form, colour, index, per, perIndex: triangles.length};
}
