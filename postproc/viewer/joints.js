// The joints and forces of one state: patches and arrows.

const kJointColours = [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0]];  // bed, head, base, other, wythe
const kReach = 5;  // pixels from an arrow within which a click selects it

class JointSet {
  /** `scale`: length of an arrow, m per N; 0: the largest force is drawn as 12 % of the size of the model. */
  constructor(scene, number, model, scale) {
    this.number = number, this.model = model, this.header = scene.header;
    this.get = (key) => scene.get(`state${number}.${key}`);
    this.count = this.get("kind").length;
    this.addPatches();
    this.addArrows(scale);
    this.findLoaded();
  }

  addPatches() {
    const g = this.shape = jointGeometry(this.get("outlines"), this.get("corners"));
    this.triangles = startsOf(this.get("corners").map((n) => n < 3 ? 0 : 3 * (n - 2)));
    const bytes = kBytes * g.rest.length / 3;
    const geometry = bufferGeometry([["position", g.rest.slice(), 3], ["edge", new Uint8Array(bytes).fill(255), kBytes, true],
                                     ["colour", new Uint8Array(bytes), kBytes, true]], g.triangles.slice());
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1e9);
    this.patches = this.model.add(new THREE.Mesh(geometry, faceMaterial(this.model.stage.shared, 1, 0, {side: THREE.DoubleSide})), false);
  }

  /** The force on the upper block of a bed and on the second block of any other joint, from its centre of pressure. */
  addArrows(scale) {
    const kind = this.get("kind"), onFirst = this.get("on_first"), spans = new Float64Array(3 * this.count);
    const colours = new Uint8Array(3 * this.count), roots = this.roots = new Float64Array(3 * this.count);
    ["x", "y", "z"].forEach((axis, k) => {
      const force = this.get(`force_${axis}_N`), point = this.get(`${axis}_m`);
      for (let j = 0; j < this.count; ++j) {
        roots[3 * j + k] = point[j];
        spans[3 * j + k] = onFirst[j] ? -force[j] : force[j];
        colours[3 * j + k] = kJointColours[kind[j]][k];
      }
    });
    this.size = Float64Array.from({length: this.count}, (_, j) => Math.hypot(spans[3 * j], spans[3 * j + 1], spans[3 * j + 2]));
    const largest = this.size.reduce((most, size) => Math.max(most, size), 0);
    this.scale = scale > 0 ? scale : largest > 0 ? 0.12 * this.model.size / largest : 0;
    this.arrows = this.model.addRods(roots, spans, colours, true);
    this.arrows.material.uniforms.scale.value = this.scale;
    this.arrows.visible = false;
  }

  /** Joints whose force is not negligible have arrows. */
  findLoaded() { this.loaded = this.size.map((size) => Number(size > this.header.floor_N)); }

  remove() {
    for (const mesh of [this.patches, this.arrows]) {
      this.model.stage.scene.remove(mesh);
      mesh.geometry.dispose();
    }
  }

  show(patches, arrows) { this.patches.visible = patches, this.arrows.visible = arrows; }

  move(pose) {
    const a = this.get("block_a"), b = this.get("block_b"), {start, rest} = this.shape, d = [0, 0, 0];
    const patch = this.patches.geometry.attributes.position, root = this.arrows.geometry.attributes.position;
    const per = this.arrows.userData.rods.per, displaced = this.header.film.kind !== "mechanism";
    for (let j = 0; j < this.count; ++j) {
      pose.jointOffset(a[j], b[j], displaced, d);
      for (let i = 3 * start[j]; i < 3 * start[j + 1]; ++i) patch.array[i] = rest[i] + d[i % 3];
      for (let i = 3 * per * j; i < 3 * per * (j + 1); ++i) root.array[i] = this.roots[3 * j + i % 3] + d[i % 3];
    }
    patch.needsUpdate = root.needsUpdate = true;
  }

  filter(shown) {
    const a = this.get("block_a"), b = this.get("block_b"), {rods, all} = this.arrows.userData;
    const both = (j) => shown[a[j]] && shown[b[j]];
    keepOwners(this.patches.geometry, this.shape.triangles, this.triangles, both);
    const starts = Int32Array.from({length: this.count + 1}, (_, j) => j * rods.perIndex);
    keepOwners(this.arrows.geometry, all, starts, (j) => both(j) && this.loaded[j]);
  }

  /** The outline of a joint as points, closed. */
  outline(j) {
    const at = this.patches.geometry.attributes.position.array, {start} = this.shape, ends = [];
    for (let v = start[j]; v < start[j + 1]; ++v)
      for (const end of [v, v + 1 < start[j + 1] ? v + 1 : start[j]]) ends.push(at[3 * end], at[3 * end + 1], at[3 * end + 2]);
    return ends;
  }

  /** The joint whose arrow passes near a point of a picture of the given size, in pixels; the nearest to the camera; -1: none. */
  arrowAt(x, y, width, height, camera) {
    const {span, per, perIndex} = this.arrows.userData.rods, from = this.arrows.geometry.attributes.position.array;
    const index = this.arrows.geometry.index.array, scale = this.arrows.material.uniforms.scale.value;
    const a = new THREE.Vector3(), b = new THREE.Vector3();
    let best = -1, depth = 1;
    for (let i = 0; i < this.arrows.geometry.drawRange.count; i += perIndex) {
      const joint = Math.floor(index[i] / per), v = 3 * joint * per;
      a.set(from[v], from[v + 1], from[v + 2]);
      b.set(span[v], span[v + 1], span[v + 2]).multiplyScalar(scale).add(a);
      for (const p of [a, b]) {
        p.project(camera);
        p.x = (p.x + 1) / 2 * width, p.y = (1 - p.y) / 2 * height;
      }
      const dx = b.x - a.x, dy = b.y - a.y, along = ((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy || 1);
      const t = Math.min(Math.max(along, 0), 1);
      if (Math.hypot(a.x + t * dx - x, a.y + t * dy - y) > kReach || a.z >= depth) continue;
      best = joint, depth = a.z;
    }
    return best;
  }
}
