// Canvas, camera and drawing on demand.

/** True if the browser draws without a graphics processor: smooth outlines would cost three quarters of the speed. */
function drawsInSoftware(context) {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  return Boolean(names) && /swiftshader|llvmpipe|software|basic render/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
}

/** A canvas in the place of the given one and its context, with smooth outlines where they cost little. */
function contextOf(canvas) {
  const open = (target, antialias) => target.getContext("webgl2", {antialias, alpha: false});
  const plain = open(canvas, false);
  if (!plain) throw new Error("this browser offers no WebGL 2");
  if (drawsInSoftware(plain)) return {canvas, context: plain, software: true};
  const smooth = canvas.cloneNode();
  canvas.replaceWith(smooth);
  return {canvas: smooth, context: open(smooth, true), software: false};
}

class Stage {
  /** `box`: the eight corners of the model; `outline`: flat coordinates of points that the standard views enclose. */
  constructor(place, host, up, box, outline) {
    const {canvas, context, software} = contextOf(place);
    this.canvas = canvas, this.host = host, this.box = box, this.outline = outline, this.software = software;
    this.up = new THREE.Vector3(...up);
    this.shared = {cut: {value: new THREE.Vector4(0, 0, 1, 1e31)}, up: {value: this.up},
                   ink: {value: new THREE.Color()}, inside: {value: new THREE.Color()}};
    this.renderer = new THREE.WebGLRenderer({canvas, context});
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
    this.camera.up.copy(this.up);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("start", () => { this.moved = true; });
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.enableZoom = false;  // the wheel scrolls the page until the picture has the focus
    canvas.addEventListener("focus", () => { this.controls.enableZoom = true; });
    canvas.addEventListener("blur", () => { this.controls.enableZoom = false; });
    canvas.addEventListener("touchstart", () => { this.controls.enableZoom = true; });
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.theme();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.theme());
    this.look("outside");
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  theme() {
    const style = getComputedStyle(this.host), read = (name) => style.getPropertyValue(name).trim();
    this.renderer.setClearColor(new THREE.Color(read("--picture")));
    this.shared.ink.value.set(read("--ink"));
    this.shared.inside.value.set(read("--inside"));
    this.invalidate();
  }

  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    const before = this.camera.aspect;
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height / (this.parts ? this.parts.length : 1);
    this.camera.updateProjectionMatrix();
    if (before !== this.camera.aspect && !this.moved) this.look(this.standard);
    this.invalidate();
  }

  invalidate() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => { this.pending = 0; this.draw(); });
  }

  /** Draws the picture. `parts`: functions that show what each part of the picture, from left to right, contains; null: one
   * picture. */
  draw() {
    const parts = this.parts || [() => {}], width = this.canvas.clientWidth / parts.length;
    this.renderer.setScissorTest(parts.length > 1);
    parts.forEach((enter, i) => {
      enter();
      this.renderer.setViewport(i * width, 0, width, this.canvas.clientHeight);
      this.renderer.setScissor(i * width, 0, width, this.canvas.clientHeight);
      this.renderer.render(this.scene, this.camera);
    });
  }

  /** Two horizontal axes and the vertical one. The first is the longer horizontal side of the model. */
  axes() {
    const z = this.up.clone(), x = Math.abs(z.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    x.addScaledVector(z, -x.dot(z)).normalize();
    const y = new THREE.Vector3().crossVectors(z, x);
    return this.extentAlong(y) > 1.5 * this.extentAlong(x) ? [y, x.negate(), z] : [x, y, z];
  }

  extentAlong(axis) {
    const along = this.box.map((corner) => corner.dot(axis));
    return Math.max(...along) - Math.min(...along);
  }

  extent(number) { return this.extentAlong(this.axes()[number]); }

  middle() {
    return this.box.reduce((sum, corner) => sum.add(corner), new THREE.Vector3()).multiplyScalar(1 / this.box.length);
  }

  /** A standard view of the whole model. */
  look(name) {
    const flat = this.extent(1) < 0.35 * this.extent(0);  // a wall or an arch
    const directions = {outside: flat ? [0.38, -0.9, 0.16] : [0.45, -0.8, 0.42], front: [0, -1, 0.02], side: [1, 0, 0.02], top: [0, -0.01, 1],
                        below: [0.25, -0.45, -1]};
    const [x, y, z] = this.axes(), d = directions[name];
    const direction = new THREE.Vector3().addScaledVector(x, d[0]).addScaledVector(y, d[1]).addScaledVector(z, d[2]).normalize();
    const camera = this.camera, size = this.box[0].distanceTo(this.middle());
    let target = this.middle(), distance = 0;
    for (let pass = 0; pass < 4; ++pass) {  // each centres what the one before shows
      const view = this.enclosing(target, direction);
      distance = view.distance, target = view.centre;
    }
    this.reach = 1.04 * distance;
    camera.position.copy(target).addScaledVector(direction, this.reach);
    camera.near = size / 200, camera.far = 50 * size;
    camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.standard = name, this.moved = false;
    this.controls.update();
    this.invalidate();
  }

  /** The distance from the target at which the picture encloses the outline, and the point that is then in its middle. */
  enclosing(target, direction) {
    const camera = this.camera, slope = Math.tan(camera.fov * Math.PI / 360), p = new THREE.Vector3();
    camera.position.copy(target).add(direction);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    const inverse = new THREE.Matrix4().getInverse(camera.matrixWorld), {outline} = this;
    const each = (visit) => {
      for (let i = 0; i < outline.length; i += 3) visit(p.set(outline[i], outline[i + 1], outline[i + 2]).applyMatrix4(inverse));
    };
    let distance = 0;
    each(({x, y, z}) => { distance = Math.max(distance, Math.max(Math.abs(x) / (slope * camera.aspect), Math.abs(y) / slope) + z + 1); });
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    each(({x, y, z}) => [x, y].forEach((value, k) => {
      const place = value / (distance - z - 1);
      low[k] = Math.min(low[k], place), high[k] = Math.max(high[k], place);
    }));
    const [right, upward] = [0, 1].map((k) => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k).multiplyScalar(0.5 * distance * (low[k] + high[k])));
    return {distance, centre: target.clone().add(right).add(upward)};
  }

  /** Takes the view of another stage, in proportion to the sizes of the two models. */
  follow(other) {
    const from = other.middle(), to = this.middle(), ratio = this.reach / other.reach;
    const moved = (point) => point.clone().sub(from).multiplyScalar(ratio).add(to);
    this.controls.target.copy(moved(other.controls.target));
    this.camera.position.copy(moved(other.camera.position));
    this.moved = other.moved;
    this.controls.update();
    this.invalidate();
  }

  key(event) {
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (turns[event.key]) this.turn(0.1 * turns[event.key][0], 0.1 * turns[event.key][1]);
    else if (event.key === "+" || event.key === "=") this.zoom(0.9);
    else if (event.key === "-") this.zoom(1 / 0.9);
    else if (event.key === "Home") this.look("outside");
    else return;
    event.preventDefault();
  }

  turn(around, over) {
    const target = this.controls.target, arm = this.camera.position.clone().sub(target);
    const side = new THREE.Vector3().crossVectors(this.up, arm).normalize();
    const steep = arm.angleTo(this.up);
    arm.applyAxisAngle(side, -Math.min(Math.max(over, steep - Math.PI + 0.02), steep - 0.02));
    arm.applyAxisAngle(this.up, around);
    this.camera.position.copy(target).add(arm);
    this.moved = true;
    this.controls.update();
    this.invalidate();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.moved = true;
    this.controls.update();
    this.invalidate();
  }
}
