// Where the blocks are: the displacement of a frame times a factor, plus the distance by which the model or its wythes are
// pulled apart.

class Pose {
  constructor(scene) {
    this.centroid = scene.get("block.centroid");
    this.blocks = this.centroid.length / 3;
    this.film = scene.header.film;
    this.shifts = scene.get("film.shift");
    this.turns = scene.get("film.turn");
    this.byWythe = scene.has("block.apart") ? scene.get("block.apart") : new Float64Array(this.centroid.length);  // of one wythe's step
    this.centre = [0, 1, 2].map((k) => {
      let sum = 0;
      for (let b = 0; b < this.blocks; ++b) sum += this.centroid[3 * b + k];
      return sum / this.blocks;
    });
    this.offset = new Float64Array(3 * this.blocks);     // of the centroids
    this.rotation = new Float64Array(9 * this.blocks);   // row by row
    this.frame = 0, this.factor = 1, this.apart = 0, this.step = 0;  // step: m from wythe to wythe
    this.update();
  }

  update() {
    const at = 3 * this.blocks * this.frame;
    for (let b = 0; b < this.blocks; ++b) {
      for (let k = 0; k < 3; ++k) {
        const i = 3 * b + k;
        this.offset[i] = this.factor * this.shifts[at + i] + this.apart * (this.centroid[i] - this.centre[k]) + this.step * this.byWythe[i];
      }
      this.rotate(b, at + 3 * b);
    }
  }

  /** Rodrigues' formula for the rotation vector at `t`, times the factor. */
  rotate(b, t) {
    const f = this.factor, x = f * this.turns[t], y = f * this.turns[t + 1], z = f * this.turns[t + 2];
    const angle = Math.hypot(x, y, z), m = this.rotation, o = 9 * b;
    const s = angle < 1e-9 ? 1 : Math.sin(angle) / angle;
    const c = angle < 1e-9 ? 0.5 : (1 - Math.cos(angle)) / (angle * angle);
    m[o] = 1 - c * (y * y + z * z), m[o + 1] = c * x * y - s * z, m[o + 2] = c * x * z + s * y;
    m[o + 3] = c * x * y + s * z, m[o + 4] = 1 - c * (x * x + z * z), m[o + 5] = c * y * z - s * x;
    m[o + 6] = c * x * z - s * y, m[o + 7] = c * y * z + s * x, m[o + 8] = 1 - c * (x * x + y * y);
  }

  /** Moves the points of every block from `rest` to `out`; `start`: first point of every block. */
  movePoints(rest, start, out) {
    for (let b = 0; b < this.blocks; ++b) this.moveBlock(b, rest, 3 * start[b], 3 * start[b + 1], out);
  }

  /** The same for the coordinates from `from` to `to`, which belong to one block. */
  moveBlock(b, rest, from, to, out) {
    const c = this.centroid, d = this.offset, m = this.rotation, q = 3 * b, o = 9 * b;
    for (let i = from; i < to; i += 3) {
      const x = rest[i] - c[q], y = rest[i + 1] - c[q + 1], z = rest[i + 2] - c[q + 2];
      out[i] = c[q] + d[q] + m[o] * x + m[o + 1] * y + m[o + 2] * z;
      out[i + 1] = c[q + 1] + d[q + 1] + m[o + 3] * x + m[o + 4] * y + m[o + 5] * z;
      out[i + 2] = c[q + 2] + d[q + 2] + m[o + 6] * x + m[o + 7] * y + m[o + 8] * z;
    }
  }

  /** How far a joint, which is stored where it was computed, moves with its two blocks on the mean. */
  jointOffset(a, b, computed, out) {
    const at = 3 * this.blocks * this.frame;
    for (let k = 0; k < 3; ++k) {
      const i = 3 * a + k, j = 3 * b + k;
      const known = computed ? this.shifts[at + i] + this.shifts[at + j] : 0;
      out[k] = 0.5 * (this.offset[i] + this.offset[j] - known);
    }
  }

  /** Displacements of the centroids in the frame, without factor, m. */
  displacement(block) {
    const i = 3 * (this.blocks * this.frame + block);
    return Math.hypot(this.shifts[i], this.shifts[i + 1], this.shifts[i + 2]);
  }
}
