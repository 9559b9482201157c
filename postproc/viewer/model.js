// The drawn objects of a scene: blocks, joints of one or two states, lines, and what is selected.

const kLineColours = {thrust: [213, 16, 62], wythe: [0, 158, 115], least: [0, 114, 178], greatest: [120, 60, 160], crack: [200, 0, 0]};
const kSelected = [255, 0, 200];

class Model {
  constructor(scene, stage) {
    this.scene = scene, this.stage = stage, this.header = scene.header;
    this.pose = new Pose(scene);
    this.ring = scene.get("block.ring");
    this.course = Infinity, this.laid = Infinity, this.born = null;  // stages: frame shown, and per block the one in which it is laid
    this.member = scene.has("block.member") ? scene.get("block.member") : null, this.hidden = new Set();  // of members
    this.sets = [];  // the state shown, and the one beside it
    this.addBlocks();
    this.addLines();
    this.addTies();
    this.selection = this.addRods([], [], [], false, {depthTest: false});
    this.selection.renderOrder = 3;
    this.showStates(this.header.states.length ? [0] : []);
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
    const geometry = bufferGeometry([["position", b.rest.slice(), 3], ["edge", b.edge, kBytes, true],
                                     ["colour", new Uint8Array(kBytes * b.rest.length / 3), kBytes, true]], this.allVertices.slice());
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1e9);
    this.materials = {
      solid: faceMaterial(shared, 1, 0.7, {}),
      ghost: faceMaterial(shared, 0.07, 0.22, {transparent: true, depthWrite: false}),
      edges: faceMaterial(shared, 0, 0.45, {transparent: true, depthWrite: false}),
    };
    this.faces = this.add(new THREE.Mesh(geometry, this.materials.solid));
  }

  addRods(roots, spans, colours, arrow, options) {
    const rods = rodGeometry(roots, spans, colours, arrow);
    const mesh = this.add(new THREE.Mesh(rodBuffers(rods), rodMaterial(this.stage.shared, options || {})));
    mesh.userData = {rods, all: rods.index.slice()};
    mesh.material.uniforms.thickness.value = 0.0012 * this.size;
    return mesh;
  }

  /** Polylines: thrust lines, and the outlines of open joints. */
  addLines() {
    const points = this.scene.get("lines"), ends = {};
    let at = 0;
    for (const line of this.header.lines) {
      const of = ends[line.what] = ends[line.what] || [];
      for (let i = at; i + 1 < at + line.count; ++i) of.push(...points.subarray(3 * i, 3 * i + 6));
      at += line.count;
    }
    this.lines = {};
    for (const [what, of] of Object.entries(ends)) {
      const {roots, spans, colours} = segments(of, kLineColours[what]);
      this.lines[what] = this.addRods(roots, spans, colours, false, {depthTest: what === "crack"});
      this.lines[what].renderOrder = 2;
      this.lines[what].visible = false;
    }
  }

  /** Chains and other ties as bars coloured by their tension. */
  addTies() {
    if (!this.header.ties) return;
    const points = this.scene.get("ties"), force = this.scene.get("tie.force"), roots = [], spans = [], colours = [];
    this.tieScale = {...scaleOf(force, ""), stops: kTension};
    for (let i = 0; i < force.length; ++i)
      for (let k = 0; k < 3; ++k) {
        roots.push(points[6 * i + k]);
        spans.push(points[6 * i + 3 + k] - points[6 * i + k]);
        colours.push(colourAt(this.tieScale, force[i])[k]);
      }
    this.ties = this.addRods(roots, spans, colours, false, {depthTest: false});
    this.ties.material.uniforms.thickness.value *= 5;
    this.ties.renderOrder = 2, this.ties.visible = false;
  }

  /** Shows the joints and forces of these states, two of them side by side. Both have the scale of the first state. */
  showStates(numbers) {
    for (const set of this.sets) set.remove();
    this.sets = [];
    for (const number of numbers) this.sets.push(new JointSet(this.scene, number, this, this.forceScale || 0));
    if (!this.forceScale && this.sets.length) this.forceScale = this.sets[0].scale;
    this.selected = null;
    this.update();
  }

  setForceScale(factor) {
    for (const set of this.sets) set.arrows.material.uniforms.scale.value = factor * this.forceScale;
  }

  /** Shows or hides the joints and arrows, one state per part of the picture. */
  showJoints(patches, arrows) {
    const show = (shown) => { for (const set of this.sets) set.show(patches && set === shown, arrows && set === shown); };
    show(this.sets[0]);
    this.stage.parts = this.sets.length > 1 ? this.sets.map((set) => () => show(set)) : null;
    this.stage.resize();
  }

  isShown(b) {
    return this.ring[b] <= this.course && !(this.born && this.born[b] > this.laid) && !(this.member && this.hidden.has(this.member[b]));
  }

  /** Moves everything to the pose and hides what is not shown. */
  update() {
    const position = this.faces.geometry.attributes.position;
    this.pose.update();
    this.pose.movePoints(this.blocks.rest, this.blocks.start, position.array);
    position.needsUpdate = true;
    for (const set of this.sets) set.move(this.pose);
    this.filter();
    this.markSelection();
  }

  /** What standard views enclose: the points at rest, and those of the frame shown, but for blocks that have gone far away. */
  outline() {
    const points = Array.from(this.scene.get("vertices")), {start} = this.blocks, at = this.faces.geometry.attributes.position.array;
    for (let b = 0; b < this.pose.blocks; ++b)
      if (this.pose.displacement(b) < 0.5 * this.size) for (let i = 3 * start[b]; i < 3 * start[b + 1]; ++i) points.push(at[i]);
    return points;
  }

  /** True if all blocks are in place, so that the inner faces of the joints cannot be seen. */
  get isClosed() {
    const far = this.pose.factor * this.header.film.largest_shift_m;
    return this.faces.material === this.materials.solid && this.pose.apart === 0 && this.pose.step === 0 && this.hidden.size === 0 && far < 1e-3 * this.size &&
           this.stage.shared.cut.value.w > 1e30 && this.course === Infinity && this.laid === Infinity;
  }

  filter() {
    const shown = Uint8Array.from({length: this.ring.length}, (_, b) => this.isShown(b));
    const {start, outerEnd} = this.blocks;
    keepOwners(this.faces.geometry, this.allVertices, start, (b) => shown[b], this.isClosed ? outerEnd : undefined);
    for (const set of this.sets) set.filter(shown);
    this.stage.invalidate();
  }

  /** Colours blocks by a function that returns three bytes. */
  paintBlocks(colourOf) { paint(this.faces.geometry, this.blocks.start, colourOf, this.stage); }

  /** Colours the joints of one state. */
  paintJoints(set, colourOf) { paint(set.patches.geometry, set.shape.start, colourOf, this.stage); }

  /** `choice`: {what: "block" or "joint", index, set: of the joint}; null: nothing. */
  select(choice) {
    this.selected = choice;
    this.markSelection();
    this.stage.invalidate();
  }

  /** Draws the edges of the selected block or the outline of the selected joint, in front of everything. */
  markSelection() {
    let ends = [];
    if (this.selected && this.selected.what === "block") {
      const rest = this.shape.outline(this.selected.index);
      ends = new Float64Array(rest.length);
      this.pose.moveBlock(this.selected.index, rest, 0, rest.length, ends);
    } else if (this.selected) {
      ends = this.selected.set.outline(this.selected.index);
    }
    const {roots, spans, colours} = segments(ends, kSelected);
    this.selection.geometry.dispose();
    this.selection.geometry = rodBuffers(rodGeometry(roots, spans, colours, false));
    this.selection.visible = roots.length > 0;
  }

  /** The block or joint at a point of the canvas, in pixels from its upper left corner; null if there is none. */
  at(x, y) {
    const {clientWidth, clientHeight} = this.stage.canvas, {camera} = this.stage, cut = this.stage.shared.cut.value;
    const width = clientWidth / (this.stage.parts ? this.stage.parts.length : 1), part = Math.min(Math.floor(x / width), 1);
    const set = this.sets[part] || this.sets[0], shows = (mesh) => this.sets[0] && this.sets.some((s) => s[mesh].visible);
    const joint = shows("arrows") ? set.arrowAt(x - part * width, y, width, clientHeight, camera) : -1;
    if (joint >= 0) return {what: "joint", index: joint, set};
    const ray = new THREE.Raycaster(), targets = shows("patches") ? [set.patches] : [];
    ray.setFromCamera({x: 2 * (x - part * width) / width - 1, y: 1 - 2 * y / clientHeight}, camera);
    if (this.faces.visible && (this.faces.material === this.materials.solid || !targets.length)) targets.push(this.faces);
    const hit = ray.intersectObjects(targets).find((h) => h.point.x * cut.x + h.point.y * cut.y + h.point.z * cut.z <= cut.w);
    if (!hit) return null;
    return hit.object === this.faces ? {what: "block", index: this.blocks.blockOf[hit.face.a / 3 | 0]}
                                     : {what: "joint", index: set.shape.jointOf[hit.face.a], set};
  }
}

/** Rods between pairs of ends, in one colour. */
function segments(ends, colour) {
  const roots = [], spans = [], colours = [];
  for (let i = 0; i + 5 < ends.length; i += 6)
    for (let k = 0; k < 3; ++k) {
      roots.push(ends[i + k]);
      spans.push(ends[i + 3 + k] - ends[i + k]);
      colours.push(colour[k]);
    }
  return {roots, spans, colours};
}

function rodBuffers({root, span, form, colour, index}) {
  return bufferGeometry([["position", root, 3], ["span", span, 3], ["form", form, 4], ["colour", colour, kBytes, true]], index);
}

function paint(geometry, start, colourOf, stage) {
  const {colour} = geometry.attributes;
  for (let o = 0; o + 1 < start.length; ++o) {
    const rgb = colourOf(o);
    for (let v = start[o]; v < start[o + 1]; ++v) for (let k = 0; k < 3; ++k) colour.array[kBytes * v + k] = rgb[k];
  }
  colour.needsUpdate = true;
  stage.invalidate();
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
