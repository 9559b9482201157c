// The numbers of the block or joint that was clicked. The attribute data-value holds the number as in the CSV table.

/** "x" for the key of the first component of a vector; "" for other keys. */
function component(key) {
  const match = key.match(/(?:^|_)([xyz])_/);
  return match ? match[1] : "";
}

function numberRow(column, value) {
  const axis = component(column.key);
  return `<tr><th title="${escaped(column.meaning)}">${escaped(column.label)}${axis ? ", " + axis : ""}</th>` +
         `<td data-key="${column.key}" data-value="${value}" title="${value}${column.unit ? " " + column.unit : ""}">${shown(value, column.unit)}</td></tr>`;
}

class Numbers {
  constructor(scene, model) { this.scene = scene, this.model = model, this.header = scene.header; }

  blockName(b) {
    const name = this.header.names ? this.header.names[b] : "";
    return `Block ${b}${name ? " (" + name + ")" : ""}`;
  }

  course(ring) { return ring >= 0 && this.header.courses > 0 ? `, course ${ring}` : ""; }

  html({what, index, set}) { return what === "block" ? this.block(index) : this.joint(index, set); }

  block(b) {
    const group = this.header.roles[this.scene.get("block.role")[b]];
    const rows = this.header.block_columns.map((c) => numberRow(c, this.scene.get("block." + c.key)[b]));
    return `<h3>${escaped(this.blockName(b))}</h3><p>${escaped(group)}${this.course(this.scene.get("block.ring")[b])}</p>` +
           `<table>${rows.join("")}</table>` + this.jointsOf(b);
  }

  jointsOf(block) {
    if (!this.model.sets.length) return "";
    const {get} = this.model.sets[0], a = get("block_a"), b = get("block_b"), found = [];
    for (let j = 0; j < a.length; ++j) if (a[j] === block || b[j] === block) found.push(j);
    const link = (j) => `<a href="#" data-joint="${j}">${this.header.kinds[get("kind")[j]]} joint with ${a[j] === block ? b[j] : a[j]}</a>`;
    return `<p>${found.map(link).join(", ")}</p>`;
  }

  joint(j, {get, number}) {
    const kind = this.header.kinds[get("kind")[j]];
    const side = (b) => `<a href="#" data-block="${b}">${escaped(this.blockName(b).toLowerCase())}</a>`;
    const rows = this.header.joint_columns.map((c) => numberRow(c, get(c.key)[j]));
    return `<h3>Joint ${j}${this.header.states.length > 1 ? ", " + escaped(this.header.states[number].name) : ""}</h3><p>${escaped(kind[0].toUpperCase() + kind.slice(1))} joint between ${side(get("block_a")[j])} and ` +
           `${side(get("block_b")[j])}${this.course(get("ring")[j])}. Forces act on the second block.</p><table>${rows.join("")}</table>`;
  }
}
