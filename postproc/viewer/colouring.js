// What the colours mean: by bond, by displacement, by body, or by a column of the tables of blocks or joints.

class Colouring {
  constructor(scene, model) {
    this.scene = scene, this.model = model, this.header = scene.header;
    this.key = "bond";
    this.peers = [this];  // views with one scale
  }

  /** The choices: groups of [value, label]. */
  choices() {
    const label = (column) => column.label;
    const blocks = [["bond", "Bond"]];
    if (this.header.members.length) blocks.push(["member", "Wythe"]);
    if (this.header.film.largest_shift_m > 0) blocks.push(["displacement", "Displacement"]);
    if (this.header.bodies > 0) blocks.push(["body", "Bodies that move as one"]);
    for (const column of this.header.block_columns) if (column.colour) blocks.push(["block." + column.key, label(column)]);
    const joints = this.header.states.length && this.header.joint_outlines
      ? this.header.joint_columns.filter((c) => c.colour).map((c) => ["joint." + c.key, label(c)]) : [];
    return [["Blocks", blocks], ["Joints", joints]];
  }

  get ofJoints() { return this.key.startsWith("joint."); }

  /** Paints the model and returns the legend as HTML. */
  apply() {
    const one = !this.header.members.length;  // wythe, beside a view of a shell with several
    if (this.key === "bond" || (this.key === "member" && one)) return this.byName(this.scene.get("block.role"), this.header.roles, kRoles);
    if (this.key === "member") {
      const names = this.header.members, last = names.length - 1;
      const colours = names.map((_, i) => i === last ? kBodies[0] : kBodies[1 + i % (kBodies.length - 1)]);
      return this.byName(this.scene.get("block.member"), names, colours);
    }
    if (this.key === "body") {
      const body = this.scene.get("block.body");
      const colour = (n) => n === 0 ? kBodies[0] : kBodies[1 + (n - 1) % (kBodies.length - 1)];
      this.model.paintBlocks((b) => colour(body[b]));
      return swatches([[kBodies[0], "Supports, and what stands with them"], [kBodies[1], "Other colours: bodies that move"]]);
    }
    return this.byNumber();
  }

  byName(codes, names, colours) {
    this.model.paintBlocks((b) => colours[codes[b]]);
    const present = new Set(codes);
    return swatches(names.map((name, i) => [colours[i], name]).filter((_, i) => present.has(i)));
  }

  byNumber() {
    if (this.ofJoints) return this.byJointColumn(this.key.slice(6));
    const moved = this.key === "displacement", name = this.key.replace("block.", ""), {pose} = this.model;
    const mechanism = this.header.film.kind === "mechanism";  // has no amplitude
    const unit = moved && mechanism ? this.header.film.largest_shift_m : 1;
    const values = moved ? Float64Array.from({length: pose.blocks}, (_, b) => pose.displacement(b) / unit) : this.scene.get(this.key);
    const farthest = mechanism ? 1 : Math.max(...this.peers.map((peer) => peer.header.film.largest_shift_m));
    const all = this.fromPeers((peer) => peer.scene.has(this.key) ? [peer.scene.get(this.key)] : []);
    const column = moved ? {label: mechanism ? "Displacement / largest displacement" : "Displacement", unit: mechanism ? "" : "m"} : this.header.block_columns.find((c) => c.key === name);
    const scale = moved ? {stops: kSequential, low: 0, high: farthest} : scaleOf(all, name);
    const fixed = this.scene.get("block.fixed");
    this.model.paintBlocks((b) => fixed[b] ? kUndefined : colourAt(scale, values[b]));
    return bar(column, scale, values.some((v) => Number.isNaN(v)));
  }

  /** The arrays of all views in one. */
  fromPeers(arraysOf) {
    const arrays = [].concat(...this.peers.map(arraysOf));
    return arrays.length === 1 ? arrays[0] : [].concat(...arrays.map((array) => Array.from(array)));
  }

  /** Two states side by side have one scale. */
  byJointColumn(name) {
    const {sets} = this.model, has = (peer) => peer.header.joint_columns.some((column) => column.key === name);
    const all = this.fromPeers((peer) => has(peer) ? peer.model.sets.map((set) => set.get(name)) : []), scale = scaleOf(all, name);
    for (const set of sets) {
      const values = set.get(name);
      this.model.paintJoints(set, (j) => colourAt(scale, values[j]));
    }
    return bar(this.header.joint_columns.find((c) => c.key === name), scale, all.some((v) => Number.isNaN(v)));
  }
}

const css = (c) => `rgb(${c.map(Math.round).join(",")})`;

function swatches(entries) {
  return entries.map(([colour, name]) => `<span class="swatch"><i style="background:${css(colour)}"></i>${escaped(name)}</span>`).join("");
}

function bar(column, scale, gaps) {
  const [factor, unit] = unitFor(Math.max(Math.abs(scale.low), Math.abs(scale.high)), column.unit);
  const number = (v) => digits(v / factor);
  const middle = scale.low < 0 ? "0" : "";
  return `<b>${escaped(column.label)}${unit ? ", " + unit : ""}</b>` +
    `<span class="ends"><span>${scale.cutLow ? "≤ " : ""}${number(scale.low)}</span>` +
    `<span class="bar" style="background:linear-gradient(to right,${scale.stops.map(css).join(",")})">${middle}</span>` +
    `<span>${scale.cutHigh ? "≥ " : ""}${number(scale.high)}</span></span>` +
    (gaps ? swatches([[kUndefined, "no force"]]) : "");
}

function escaped(text) {
  return String(text).replace(/[&<>"]/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"}[c]));
}
