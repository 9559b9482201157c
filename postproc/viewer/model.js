// The drawn objects of a scene: blocks, joints, arrows, lines, and what is selected.

const kJointColours = [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167]];  // bed, head, base, other
const kLineColours = {thrust: [213, 16, 62], least: [0, 114, 178], greatest: [120, 60, 160], crack: [200, 0, 0]};
const kSelected = [255, 0, 200];

class Model {
  constructor(scene, stage) {
    this.scene = scene, this.stage = stage, this.header = scene.header;
    this.pose = new Pose(scene);
    this.ring = scene.get("block.ring");
    this.course = Infinity, this.laid = Infinity;
    this.state = 0;
    this.addBlocks();
    this.addLines();
    this.selection = this.addRods([], [], [], false, {depthTest: false});
    this.selection.renderOrder = 3;
    this.showState(0);
    this.update();
  }

  get size() { return this.stage.box[0].distanceTo(this.stage.box[7]); }

  add(object, visible = true) {
    object.frustumCulled = false, object.visible = visible, object.matrixAutoUpdate = false;
    this.stage.scene.add(object);
    return object;
  }

  addBlocks() {
    this.shape = new BlockFaces(this.scene);
    const b = this.blocks = this.shape.triangles(), shared = this.stage.shared;
    this.allVertices = Uint32Array.from({length: b.rest.length / 3}, (_, i) => i);
    const geometry = bufferGeometry([["position", b.rest.slice(), 3], ["edge", b.edge, 3, true],
                                     ["colour", new Uint8Array(b.rest.length), 3, true]], this.allVertices.slice());
    geometry.boundingSphere = new THREE.Sphere(this.stage.middle(), 1e9);
    this.materials = {
      solid: faceMaterial(shared, 1, 0.7, {}),
      ghost: faceMaterial(shared, 0.07, 0.22, {transparent: true, depthWrite: false}),
      edges: faceMaterial(shared, 0, 0.45, {transparent: true, depthWrite: false}),
    };
    this.faces = this.add(new THREE.Mesh(geometry, this.materials.solid));
  }

  addRods(roots, spans, colours, arrow, options) {
    const rods = rodGeometry(roots, spans, colours, arrow);
    const geometry = bufferGeometry([["position", rods.root, 3], ["span", rods.span, 3], ["form", rods.form, 4],
                                     ["colour", rods.colour, 3, true]], rods.index);
    const mesh = this.add(new THREE.Mesh(geometry, rodMaterial(this.stage.shared, options || {})));
    mesh.userData = {rods, all: rods.index.slice()};
    mesh.material.uniforms.thickness.value = 0.0012 * this.size;
    return mesh;
  }

  /** Polylines: thrust lines, and the outlines of open joints. */
  addLines() {
    const points = this.scene.get("lines"), groups = {};
    let at = 0;
    for (const line of this.header.lines) {
      const of = groups[line.what] = groups[line.what] || {roots: [], spans: [], colours: []};
      for (let i = at; i + 1 < at + line.count; ++i)
        for (let k = 0; k < 3; ++k) {
          of.roots.push(points[3 * i + k]);
          of.spans.push(points[3 * i + 3 + k] - points[3 * i + k]);
          of.colours.push((kLineColours[line.what] || [90, 90, 90])[k]);
        }
      at += line.count;
    }
    this.lines = {};
    for (const [what, of] of Object.entries(groups)) {
      this.lines[what] = this.addRods(of.roots, of.spans, of.colours, false, {depthTest: what === "crack"});
      this.lines[what].renderOrder = 2;
      this.lines[what].visible = false;
    }
  }

  /** The joints and forces of one state. */
  showState(number) {
    for (const old of [this.joints, this.arrows]) if (old) { this.stage.scene.remove(old); old.geometry.dispose(); }
    this.joints = this.arrows = null;
    this.state = number;
    if (!this.header.states.length) return;
    const get = this.joint = (key) => this.scene.get(`state${number}.${key}`);
    const g = this.jointShape = jointGeometry(get("outlines"), get("corners"));
    this.jointTriangles = startsOf(get("corners").map((n) => n < 3 ? 0 : 3 * (n - 2)));
    const geometry = bufferGeometry([["position", g.rest.slice(), 3], ["edge", new Uint8Array(g.rest.length).fill(255), 3, true],
                                     ["colour", new Uint8Array(g.rest.length), 3, true]], g.triangles.slice());
    geometry.boundingSphere = new THREE.Sphere(this.stage.middle(), 1e9);
    this.joints = this.add(new THREE.Mesh(geometry, faceMaterial(this.stage.shared, 1, 0, {side: THREE.DoubleSide})), false);
    this.addArrows(get);
  }

  /** The force on the upper block of a bed and on the second block of any other joint, from its centre of pressure. */
  addArrows(get) {
    const kind = get("kind"), onFirst = get("on_first"), roots = [], spans = [], colours = [];
    const force = ["x", "y", "z"].map((k) => get(`force_${k}_N`)), point = ["x", "y", "z"].map((k) => get(`${k}_m`));
    let largest = 0;
    for (let j = 0; j < kind.length; ++j) {
      largest = Math.max(largest, Math.hypot(force[0][j], force[1][j], force[2][j]));
      for (let k = 0; k < 3; ++k) {
        roots.push(point[k][j]);
        spans.push(onFirst[j] ? -force[k][j] : force[k][j]);
        colours.push(kJointColours[kind[j]][k]);
      }
    }
    this.largestForce = largest;
    this.arrows = this.addRods(roots, spans, colours, true);
    this.arrows.visible = false;
    this.arrows.material.uniforms.scale.value = this.forceScale = largest > 0 ? 0.12 * this.size / largest : 0;
    this.arrowRoots = Float32Array.from(roots);
  }

  setForceScale(factor) {
    if (this.arrows) this.arrows.material.uniforms.scale.value = factor * this.forceScale;
  }

  isShown(b) { return this.ring[b] <= this.course && this.ring[b] < this.laid; }

  /** Moves everything to the pose and hides what is not shown. */
  update() {
    const position = this.faces.geometry.attributes.position;
    this.pose.update();
    this.pose.movePoints(this.blocks.rest, this.blocks.start, position.array);
    position.needsUpdate = true;
    this.moveJoints();
    this.filter();
    this.markSelection();
  }

  /** True if all blocks are in place, so that the inner faces of the joints cannot be seen. */
  get isClosed() {
    const far = this.pose.factor * this.header.film.largest_shift_m;
    return this.faces.material === this.materials.solid && this.pose.apart === 0 && far < 1e-3 * this.size &&
           this.stage.shared.cut.value.w > 1e30 && this.course === Infinity && this.laid === Infinity;
  }

  filter() {
    const shown = Uint8Array.from({length: this.ring.length}, (_, b) => this.isShown(b));
    const {start, outerEnd} = this.blocks;
    keepOwners(this.faces.geometry, this.allVertices, start, (b) => shown[b], this.isClosed ? outerEnd : undefined);
    if (this.joints) {
      const a = this.joint("block_a"), b = this.joint("block_b"), none = this.floorForce();
      const both = (j) => shown[a[j]] && shown[b[j]];
      keepOwners(this.joints.geometry, this.jointShape.triangles, this.jointTriangles, both);
      const {rods, all} = this.arrows.userData, starts = Int32Array.from({length: a.length + 1}, (_, j) => j * rods.perIndex);
      keepOwners(this.arrows.geometry, all, starts, (j) => both(j) && !none(j));
    }
    this.stage.invalidate();
  }

  /** True for joints whose force is negligible. */
  floorForce() {
    const f = ["x", "y", "z"].map((k) => this.joint(`force_${k}_N`)), floor = this.header.floor_N;
    return (j) => Math.hypot(f[0][j], f[1][j], f[2][j]) <= floor;
  }

  moveJoints() {
    if (!this.joints) return;
    const a = this.joint("block_a"), b = this.joint("block_b"), {start, rest} = this.jointShape, d = [0, 0, 0];
    const patch = this.joints.geometry.attributes.position, root = this.arrows.geometry.attributes.position;
    const per = this.arrows.userData.rods.per;
    for (let j = 0; j < a.length; ++j) {
      this.pose.jointOffset(a[j], b[j], this.header.film.kind !== "mechanism", d);
      for (let i = 3 * start[j]; i < 3 * start[j + 1]; ++i) patch.array[i] = rest[i] + d[i % 3];
      for (let i = 3 * per * j; i < 3 * per * (j + 1); ++i) root.array[i] = this.arrowRoots[3 * j + i % 3] + d[i % 3];
    }
    patch.needsUpdate = root.needsUpdate = true;
  }

  /** Colours every block, or every joint, by a function that returns three bytes. */
  paint(what, colourOf) {
    const mesh = what === "joint" ? this.joints : this.faces;
    const start = what === "joint" ? this.jointShape.start : this.blocks.start;
    const colour = mesh.geometry.attributes.colour;
    for (let o = 0; o + 1 < start.length; ++o) {
      const rgb = colourOf(o);
      for (let v = start[o]; v < start[o + 1]; ++v) for (let k = 0; k < 3; ++k) colour.array[3 * v + k] = rgb[k];
    }
    colour.needsUpdate = true;
    this.stage.invalidate();
  }

  select(what, index) {
    this.selected = what === null ? null : {what, index};
    this.markSelection();
    this.stage.invalidate();
  }

  /** Draws the edges of the selected block or the outline of the selected joint, in front of everything. */
  markSelection() {
    const roots = [], spans = [], colours = [];
    const line = (points, from, to) => {
      for (let k = 0; k < 3; ++k) {
        roots.push(points[3 * from + k]), spans.push(points[3 * to + k] - points[3 * from + k]), colours.push(kSelected[k]);
      }
    };
    if (this.selected && this.selected.what === "block") {
      const rest = this.shape.outline(this.selected.index), at = new Float64Array(rest.length);
      this.pose.moveBlock(this.selected.index, rest, 0, rest.length, at);
      for (let v = 0; v < at.length / 3; v += 2) line(at, v, v + 1);
    } else if (this.selected && this.joints) {
      const at = this.joints.geometry.attributes.position.array, j = this.selected.index;
      const from = this.jointShape.start[j], to = this.jointShape.start[j + 1];
      for (let v = from; v < to; ++v) line(at, v, v + 1 < to ? v + 1 : from);
    }
    const {root, span, form, colour, index} = rodGeometry(roots, spans, colours, false);
    this.selection.geometry.dispose();
    this.selection.geometry = bufferGeometry([["position", root, 3], ["span", span, 3], ["form", form, 4],
                                              ["colour", colour, 3, true]], index);
    this.selection.visible = roots.length > 0;
  }

  /** The joint whose arrow passes within some pixels of a point of the canvas, the nearest to the camera; -1: none. */
  arrowAt(x, y) {
    const reach = 5, {clientWidth, clientHeight} = this.stage.canvas, index = this.arrows.geometry.index.array;
    const {span, per, perIndex} = this.arrows.userData.rods, from = this.arrows.geometry.attributes.position.array;
    const scale = this.arrows.material.uniforms.scale.value, a = new THREE.Vector3(), b = new THREE.Vector3();
    const toPixels = (p) => {
      p.project(this.stage.camera);
      p.x = (p.x + 1) / 2 * clientWidth, p.y = (1 - p.y) / 2 * clientHeight;
    };
    let best = -1, depth = 1;
    for (let i = 0; i < this.arrows.geometry.drawRange.count; i += perIndex) {
      const joint = Math.floor(index[i] / per), v = 3 * joint * per;
      a.set(from[v], from[v + 1], from[v + 2]);
      b.set(span[v], span[v + 1], span[v + 2]).multiplyScalar(scale).add(a);
      toPixels(a), toPixels(b);
      const dx = b.x - a.x, dy = b.y - a.y, along = ((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1);
      const t = Math.min(Math.max(along, 0), 1);
      if (Math.hypot(a.x + t * dx - x, a.y + t * dy - y) > reach || a.z >= depth) continue;
      best = joint, depth = a.z;
    }
    return best;
  }

  /** The block or joint at a point of the canvas, in pixels from its upper left corner; null if there is none. */
  at(x, y) {
    if (this.arrows && this.arrows.visible) {
      const joint = this.arrowAt(x, y);
      if (joint >= 0) return {what: "joint", index: joint};
    }
    const canvas = this.stage.canvas, ray = new THREE.Raycaster(), cut = this.stage.shared.cut.value;
    const place = {x: 2 * x / canvas.clientWidth - 1, y: 1 - 2 * y / canvas.clientHeight};
    ray.setFromCamera(place, this.stage.camera);
    const targets = [this.joints, this.faces].filter((m) => m && m.visible && !(m === this.faces && m.material !== this.materials.solid && this.joints && this.joints.visible));
    const hit = ray.intersectObjects(targets).find((h) => h.point.x * cut.x + h.point.y * cut.y + h.point.z * cut.z <= cut.w);
    if (!hit) return null;
    return hit.object === this.joints ? {what: "joint", index: this.jointShape.jointOf[hit.face.a]}
                                      : {what: "block", index: this.blocks.blockOf[hit.face.a / 3 | 0]};
  }
}

/** Keeps the triangles of the owners that pass; `starts`: first index of every owner, `ends`: end of what is kept. */
function keepOwners(geometry, all, starts, passes, ends = starts.subarray(1)) {
  const index = geometry.index.array;
  let kept = 0;
  for (let o = 0; o + 1 < starts.length; ++o) {
    if (!passes(o)) continue;
    index.set(all.subarray(starts[o], ends[o]), kept);
    kept += ends[o] - starts[o];
  }
  geometry.index.needsUpdate = true;
  geometry.setDrawRange(0, kept);
}
