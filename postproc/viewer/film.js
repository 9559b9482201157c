// Frames as a film: instants of a motion, stages of construction, or a mechanism with growing amplitude.

const kMechanismSteps = 40;  // a mechanism has directions but no amplitude: it is shown from rest to its drawn size
const kSecondsOfFilm = 8;

class Film {
  constructor(header, model, onFrame) {
    this.film = header.film, this.model = model, this.onFrame = onFrame;
    this.count = this.film.kind === "mechanism" ? kMechanismSteps + 1 : this.film.frames;
    this.frame = 0, this.timer = 0;
  }

  get isFilm() { return this.film.kind !== "displacement" && this.count > 1; }

  /** True where the joints and forces of the scene belong to the frame shown. */
  get showsForces() { return !this.isFilm || this.frame === this.film.evaluated; }

  label(i) {
    if (this.film.kind === "mechanism") return `${Math.round(100 * i / kMechanismSteps)} % of the drawn motion`;
    return this.film.labels[i];
  }

  show(i) {
    this.frame = Math.min(Math.max(Math.round(i), 0), this.count - 1);
    const pose = this.model.pose;
    if (this.film.kind === "mechanism") pose.factor = this.frame / kMechanismSteps;
    else pose.frame = this.frame;
    if (this.film.kind === "stages") this.model.born = this.film.born, this.model.laid = this.frame;
    this.model.update();
    this.onFrame();
  }

  get isPlaying() { return this.timer !== 0; }

  play() {
    if (this.isPlaying) { this.stop(); return; }
    if (this.frame === this.count - 1) this.frame = 0;
    const first = this.frame, start = performance.now();
    const rate = Math.min(Math.max(this.count / kSecondsOfFilm, 2), 50) / 1000;
    const step = (now) => {
      const i = first + Math.floor((now - start) * rate);
      if (i !== this.frame) this.show(i);
      if (i >= this.count - 1) { this.stop(); return; }
      this.timer = requestAnimationFrame(step);
    };
    this.timer = requestAnimationFrame(step);
    this.onFrame();
  }

  stop() {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.onFrame();
  }
}
