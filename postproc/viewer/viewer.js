// The 3-D view of a report: builds the controls and connects them with the model.

const kMarkup = `
  <div class="picture"><canvas tabindex="0" role="application" aria-label="Model in three dimensions. Arrow keys turn it, plus and minus zoom, Home shows it as at the start, N and P go to the next and the previous block with its numbers"></canvas>
    <canvas class="printed" aria-hidden="true"></canvas><div class="legend"></div><p class="scale"></p><div class="part-names" hidden></div><div class="forces-legend" hidden></div><div class="ties-legend" hidden></div>
    <div class="film" hidden><button class="play" type="button">Play</button><input class="frame" type="range" min="0" step="1" value="0" aria-label="Frame"><output></output></div>
  </div>
  <div class="side-panel">
    <div class="buttons views"></div>
    <label>Colours <select class="colour"></select></label>
    <label>Blocks <select class="blocks"><option value="solid">solid</option><option value="ghost">see-through</option><option value="edges">edges only</option><option value="none">hidden</option></select></label>
    <div class="states" hidden><label>Forces of <select class="state"></select></label><label>beside it <select class="second"></select></label></div>
    <div class="switches"></div>
    <div class="members switches" hidden>Show </div>
    <label class="of-forces">Length of arrows <input class="length" type="range" min="-1" max="1" step="0.01" value="0"></label>
    <label class="of-magnification">Displacement <output></output><input class="magnify" type="range" min="0" max="1" step="0.01" value="0"></label>
    <details><summary>Cut and take apart</summary>
      <label class="of-courses">Courses up to <output></output><input class="course" type="range" min="0" step="1"></label>
      <label>Cut <select class="axis"><option value="">none</option></select><input class="cut" type="range" min="0" max="1" step="0.005" value="0.5" aria-label="Place of the cut"></label>
      <label class="of-wythes">Wythes apart <input class="wythes-apart" type="range" min="0" max="1" step="0.01" value="0"></label>
      <label>Pull apart <input class="apart" type="range" min="0" max="1" step="0.01" value="0"></label>
    </details>
    <div class="numbers" aria-live="polite"><p class="hint">Drag: turn. Right drag or two fingers: move. Wheel or pinch: zoom. Click a block, an arrow or a coloured joint: its numbers. Keys: arrows, + and -, Home; N and P: next and previous block.</p></div>
    <p class="notes"></p>
  </div>`;

class Viewer {
  constructor(host, scene) {
    this.host = host, this.scene = scene, this.header = scene.header;
    host.innerHTML = kMarkup;
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(...[0, 1, 2].map((k) => this.header.box[i >> k & 1][k])));
    this.stage = new Stage(this.find("canvas"), host, this.header.up, corners, scene.get("vertices"));
    this.model = new Model(scene, this.stage);
    this.colouring = new Colouring(scene, this.model);
    this.numbers = new Numbers(scene, this.model);
    this.film = new Film(this.header, this.model, () => this.showFrame());
    this.addControls();
    this.addFilm();
    this.addPointer();
    this.addPrinting();
    this.model.filter();
    if (this.film.isFilm) this.film.show(this.film.count - 1);
    if (["motion", "mechanism"].includes(this.header.film.kind)) this.stage.outline = this.model.outline();
    this.setColour(this.header.colour);
    this.stage.look("outside");
    this.stage.draw();
  }

  find(selector) { return this.host.querySelector(selector); }

  on(selector, event, action) { this.find(selector).addEventListener(event, action); }

  addControls() {
    const views = {outside: "Outside", below: "Below", front: "Front", side: "Side", top: "Top"};
    for (const [name, text] of Object.entries(views)) this.addButton(text, () => this.stage.look(name));
    this.addButton("Save PNG", () => savePicture(this));
    this.find(".colour").innerHTML = this.colouring.choices().filter(([, list]) => list.length).map(([group, list]) =>
      `<optgroup label="${group}">` + list.map(([value, label]) => `<option value="${value}">${escaped(label)}</option>`).join("") + "</optgroup>").join("");
    this.on(".colour", "change", (e) => this.setColour(e.target.value));
    this.on(".blocks", "change", (e) => this.setBlocks(e.target.value));
    this.addStates();
    if (this.header.states.length) this.addSwitch("forces", "Forces", (on) => this.showForces(on));
    this.find(".of-forces").hidden = true;
    this.on(".length", "input", (e) => { this.model.setForceScale(10 ** e.target.value); this.forceLegend(); this.stage.invalidate(); });
    const lines = {thrust: "Thrust lines", wythe: "Thrust lines of wythes", least: "Least thrust", greatest: "Greatest thrust", crack: "Open joints"};
    for (const what of Object.keys(this.model.lines)) this.addSwitch(what, lines[what], (on) => this.showLines(what, on));
    if (this.header.ties) this.addSwitch("ties", this.header.ties, (on) => this.showTies(on));
    this.addMembers();
    this.addMagnifier();
    this.addCuts();
    this.find(".scale").textContent = this.header.scale;
    this.find(".notes").textContent = this.header.notes.join(" ");
  }

  addButton(text, action) {
    const button = document.createElement("button");
    button.type = "button", button.textContent = text;
    button.addEventListener("click", action);
    this.find(".views").append(button);
  }

  addSwitch(name, text, action, group = ".switches:not(.members)") {
    const label = document.createElement("label");
    label.innerHTML = `<input type="checkbox" name="${name}"> ${escaped(text)}`;
    label.firstChild.addEventListener("change", (e) => action(e.target.checked));
    this.find(group).append(label);
    return label.firstChild;
  }

  /** A switch for every wythe and group of bonders that has blocks, all of them on. */
  addMembers() {
    const {header, model} = this, present = new Set(model.member || []);
    this.find(".members").hidden = present.size < 2;
    this.find(".of-wythes").hidden = header.wythes < 2;
    header.members.forEach((name, m) => {
      if (!present.has(m)) return;
      this.addSwitch(`member${m}`, name, (on) => {
        on ? model.hidden.delete(m) : model.hidden.add(m);
        model.filter();
      }, ".members").checked = true;
    });
    this.on(".wythes-apart", "input", (e) => {
      model.pose.step = 0.3 * model.size * e.target.value ** 2 / Math.max(1, header.wythes - 1);
      model.update();
    });
  }

  showTies(on) {
    const legend = this.find(".ties-legend");
    this.model.ties.visible = on, legend.hidden = !on;
    legend.innerHTML = bar({label: `Tension${this.model.tieScale.low < 0 ? " (thrust negative)" : ""}, ${this.header.ties.toLowerCase()}`, unit: "N"}, this.model.tieScale, false);
    if (on && this.find(".blocks").value === "solid") this.setBlocks("ghost");
    this.stage.invalidate();
  }

  addStates() {
    const states = this.header.states.map((s, i) => `<option value="${i}">${escaped(s.name)}</option>`).join("");
    this.find(".states").hidden = this.header.states.length < 2;
    this.find(".state").innerHTML = states;
    this.find(".second").innerHTML = `<option value="">nothing</option>${states}`;
    for (const select of [".state", ".second"]) this.on(select, "change", () => this.setStates());
  }

  setStates() {
    const first = Number(this.find(".state").value), second = this.find(".second").value;
    this.model.showStates(second === "" ? [first] : [first, Number(second)]);
    const names = this.find(".part-names");
    names.hidden = second === "";
    names.innerHTML = this.model.sets.map((set) => `<span>${escaped(this.header.states[set.number].name)}</span>`).join("");
    this.setColour(this.colouring.key);
    this.showForces(this.forces || second !== "" && !this.colouring.ofJoints);
    this.select(null);
  }

  setColour(key) {
    this.colouring.key = key;
    this.find(".colour").value = key;
    if (this.colouring.ofJoints) this.goToForces();
    if (this.colouring.ofJoints && this.find(".blocks").value === "solid") this.setBlocks("ghost");
    if (!this.colouring.ofJoints && !this.forces && this.find(".blocks").value === "ghost") this.setBlocks("solid");
    this.find(".legend").innerHTML = this.colouring.apply();
    this.updateVisible();
  }

  setBlocks(mode) {
    this.find(".blocks").value = mode;
    this.model.faces.visible = mode !== "none";
    if (mode !== "none") this.model.faces.material = this.model.materials[mode];
    this.model.filter();
  }

  showForces(on) {
    this.forces = on;
    if (this.find("[name=forces]")) this.find("[name=forces]").checked = on;
    if (on) this.goToForces();
    if (on && this.find(".blocks").value === "solid") this.setBlocks("ghost");
    if (!on && !this.colouring.ofJoints && this.find(".blocks").value === "ghost") this.setBlocks("solid");
    this.find(".of-forces").hidden = !on;
    this.model.setForceScale(10 ** this.find(".length").value);
    this.forceLegend();
    this.updateVisible();
  }

  showLines(what, on) {
    this.model.lines[what].visible = on;
    this.stage.invalidate();
  }

  /** Shows the frame to which joints and forces belong. */
  goToForces() {
    if (!this.film.showsForces && this.header.film.evaluated >= 0) this.film.show(this.header.film.evaluated);
  }

  /** Joints and arrows are shown only in the frame to which they belong. */
  updateVisible() {
    const belongs = this.film.showsForces;
    this.model.showJoints(belongs && this.colouring.ofJoints, belongs && Boolean(this.forces));
    this.stage.invalidate();
  }

  forceLegend() {
    const legend = this.find(".forces-legend");
    legend.hidden = !this.forces;
    if (!this.forces) return;
    const set = this.model.sets[0], scale = set.arrows.material.uniforms.scale.value;  // m per N
    const present = new Set(set.get("kind"));
    legend.innerHTML = `<b>Forces: 1 m stands for ${shown(scale > 0 ? 1 / scale : 0, "N")}</b>` +
      swatches(this.header.kinds.map((kind, i) => [kJointColours[i], kind]).filter((_, i) => present.has(i)));
  }

  addMagnifier() {
    const film = this.header.film, output = this.find(".of-magnification output");
    const moves = film.largest_shift_m > 0 && ["displacement", "motion"].includes(film.kind);
    this.limitMagnification(moves ? Math.max(1, 0.1 * this.model.size / film.largest_shift_m) : Infinity);
    const set = (s) => {
      this.model.pose.factor = s > 0 ? this.mostMagnified ** s : 1;
      output.textContent = `× ${digits(Number(this.model.pose.factor.toPrecision(3)))}`;
    };
    set(0);
    this.on(".magnify", "input", (e) => { set(Number(e.target.value)); this.model.update(); });
  }

  /** The largest factor; Infinity: nothing moves. */
  limitMagnification(most) {
    this.mostMagnified = most;
    this.find(".of-magnification").hidden = most < 2 || most === Infinity;
  }

  addCuts() {
    const header = this.header, course = this.find(".course"), output = this.find(".of-courses output");
    this.find(".of-courses").hidden = header.courses < 2;
    course.max = course.value = header.courses - 1;
    const show = () => { output.textContent = course.value; };
    show();
    course.addEventListener("input", () => {
      this.model.course = Number(course.value) < header.courses - 1 ? Number(course.value) : Infinity;
      show();
      this.model.filter();
    });
    const [x, y, z] = this.stage.axes(), axes = [x, y.negate(), z], select = this.find(".axis");
    ["across", "along", "at a height"].forEach((text, i) => select.append(new Option(text, i)));
    const cut = () => {
      const plane = this.stage.shared.cut.value, axis = axes[select.value], place = Number(this.find(".cut").value);
      if (!axis) plane.set(0, 0, 1, 1e31);
      else {
        const along = this.stage.box.map((corner) => corner.dot(axis)), low = Math.min(...along), high = Math.max(...along);
        plane.set(axis.x, axis.y, axis.z, low + place * (high - low));
      }
      this.model.materials.solid.side = axis ? THREE.DoubleSide : THREE.FrontSide;
      this.find(".cut").disabled = !axis;
      this.model.filter();
    };
    select.addEventListener("change", cut);
    this.on(".cut", "input", cut);
    this.find(".cut").disabled = true;
    this.on(".apart", "input", (e) => { this.model.pose.apart = Number(e.target.value) ** 2; this.model.update(); });
  }

  addFilm() {
    if (!this.film.isFilm) return;
    this.find(".film").hidden = false;
    this.find(".frame").max = this.film.count - 1;
    this.on(".play", "click", () => this.film.play());
    this.on(".frame", "input", (e) => {
      const frame = Number(e.target.value);  // before stop(), which sets the slider to the frame shown
      this.film.stop();
      this.film.show(frame);
    });
    this.showFrame();
  }

  showFrame() {
    this.find(".play").textContent = this.film.isPlaying ? "Pause" : "Play";
    this.find(".frame").value = this.film.frame;
    this.find(".film output").textContent = this.film.label(this.film.frame);
    if (this.colouring.key === "displacement" && this.header.film.kind !== "mechanism") this.colouring.apply();
    this.updateVisible();
  }

  addPointer() {
    let from = null;
    const canvas = this.stage.canvas;
    canvas.addEventListener("pointerdown", (e) => { from = [e.clientX, e.clientY]; canvas.focus({preventScroll: true}); });
    canvas.addEventListener("pointerup", (e) => {
      if (!from || Math.hypot(e.clientX - from[0], e.clientY - from[1]) > 4) return;
      const box = canvas.getBoundingClientRect();
      this.select(this.model.at(e.clientX - box.left, e.clientY - box.top));
    });
    canvas.addEventListener("keydown", (e) => this.stepBlocks({n: 1, p: -1}[e.key.toLowerCase()] || 0));
    document.addEventListener("click", (e) => {
      const link = e.target.closest("[data-joint],[data-block]");
      if (!link) return;
      e.preventDefault();
      const what = "joint" in link.dataset ? "joint" : "block", set = this.model.sets[0];
      if (!this.host.contains(link)) this.find(".picture").scrollIntoView({block: "start"});
      this.select({what, index: Number(link.dataset[what]), set});
    });
  }

  /** The canvas that *Save PNG* saves, and what stands below the picture on it. */
  printed() { return {canvas: printedPicture(this), rows: legendRows(this)}; }

  /** Selects the next (1) or the previous (-1) block by number. */
  stepBlocks(step) {
    if (!step) return;
    const count = this.model.pose.blocks, old = this.chosen && this.chosen.what === "block" ? this.chosen.index : step > 0 ? -1 : count;
    this.select({what: "block", index: (old + step + count) % count, set: this.model.sets[0]});
  }

  /** Marks a block or joint and shows its numbers; null: nothing. */
  select(choice) {
    this.chosen = choice;
    this.model.select(choice);
    this.find(".numbers").innerHTML = choice ? this.numbers.html(choice) : "<p class=\"hint\">Click a block, an arrow or a coloured joint for its numbers.</p>";
  }

  /** What is printed is the picture on the screen, dark on white. */
  addPrinting() {
    const paper = {"--picture": "#ffffff", "--ink": "#1a1a1a"}, {style} = this.host, printed = this.find(".printed");
    addEventListener("beforeprint", () => {
      for (const [name, colour] of Object.entries(paper)) style.setProperty(name, colour);
      this.stage.theme();
      this.stage.draw();
      const gl = this.stage.canvas;
      printed.width = gl.width, printed.height = gl.height;
      printed.getContext("2d").drawImage(gl, 0, 0);
      for (const name of Object.keys(paper)) style.removeProperty(name);
      this.stage.theme();
    });
  }
}

async function startViewers() {
  const hosts = Array.from(document.querySelectorAll(".view"));
  try {
    const [library, ...scenes] = await Promise.all(["three", ...hosts.map((host) => host.dataset.scene)].map(inflated));
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(library);
    document.head.append(script);
    const viewers = hosts.map((host, i) => new Viewer(host, new Scene(scenes[i])));
    if (viewers.length > 1) linkViewers(viewers);
    return viewers;
  } catch (error) {
    hosts[0].innerHTML = `<p class="no-view">The 3-D view needs a browser with WebGL 2 and DecompressionStream (Firefox 113, Chrome 80, Safari 16.4 or later): ${escaped(error.message)}.</p>`;
    throw error;
  }
}
window.cupolaViews = startViewers();
window.cupolaView = window.cupolaViews.then((viewers) => viewers[0]);
