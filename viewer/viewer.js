// The whole page: draws the present moment, and does what the controls ask for.
import { Camera } from "./camera.js";
import { fixedValues, palette, rangeOf } from "./colours.js";
import { listenToControls, speeds } from "./controls.js";
import { DiskRenderer } from "./disk_renderer.js";
import { element, shortNumber } from "./format.js";
import { drawOverlay, sideSentence } from "./overlay.js";
import { colourChoices, factsOf, fillChoices, showFacts, showLegend } from "./panel.js";
import { DiskPath, diskAt } from "./picking.js";
import { pictureOf, saveAs } from "./picture.js";
import { Playback } from "./playback.js";
import { Plots } from "./plots.js";

const mostTrail = 24; // number of frames in a trail
const manyDisks = 5000; // with fewer disks each is drawn with a radius of at least 1.6 pixels, as in movies

export class Viewer {
  constructor(store) {
    this.store = store;
    this.head = store.head;
    this.playback = new Playback(store.times, () => element("smooth").checked);
    this.camera = new Camera(this.head.box);
    this.canvas = element("disks");
    this.renderer = new DiskRenderer(this.canvas, this.head.axes, this.head.box, (sentence) => {
      this.say(sentence);
      this.refresh();
    });
    this.plots = new Plots(this.head, (time) => this.jumpToTime(time));
    this.colour = this.head.colour === "group" && !this.head.grouped ? "speed" : this.head.colour;
    this.range = null; // known once a block is unpacked
    this.picked = null; // { place, path }
    this.drawn = -1; // the frame on the graphics card
    this.counts = new Map(); // coordination numbers by frame
    this.dirty = true;
    this.lastTick = 0;
    this.message = "";
  }

  start() {
    const { head } = this;
    element("frame").max = this.playback.last;
    fillChoices(element("colour"), colourChoices(head), this.colour);
    fillChoices(
      element("speed"),
      speeds.map((s) => [s, `× ${s}`]),
      1,
    );
    element("images-label").hidden = !head.axes.some((axis) => axis.periodic);
    element("sides").textContent = sideSentence(head);
    element("dark").checked = matchMedia("(prefers-color-scheme: dark)").matches;
    this.setTheme();
    listenToControls(this);
    this.followHash();
    new ResizeObserver(() => this.resize()).observe(element("stage"));
    this.resize();
    requestAnimationFrame((now) => this.tick(now));
  }

  // --- What is shown

  setTheme() {
    document.documentElement.dataset.theme = element("dark").checked ? "dark" : "light";
    const style = getComputedStyle(document.documentElement);
    this.colours = {};
    for (const name of ["ground", "ink", "faint", "line", "accent", "heat"]) {
      this.colours[name] = style.getPropertyValue(`--${name}`).trim();
    }
    this.dirty = true;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = element("stage");
    this.density = window.devicePixelRatio || 1;
    for (const canvas of [this.canvas, element("overlay")]) {
      canvas.width = Math.max(1, Math.round(width * this.density));
      canvas.height = Math.max(1, Math.round(height * this.density));
    }
    this.camera.resize(width, height);
    this.dirty = true;
  }

  say(message) {
    this.message = message;
    element("message").textContent = message;
    element("message").hidden = !message;
  }

  tick(now) {
    const seconds = Math.min(0.25, (now - this.lastTick) / 1000);
    this.lastTick = now;
    if (this.playback.playing && this.ready(this.playback.frame)) {
      this.playback.advance(seconds);
      this.dirty = true;
      this.showPlaying();
    }
    if (this.dirty) this.draw();
    requestAnimationFrame((next) => this.tick(next));
  }

  // Are the blocks of frame k (its own, and that of the next frame) unpacked? Asks for those that are missing, and for
  // the next one. A damaged block counts as unpacked: the page reports it and goes on after it.
  ready(k) {
    const { store } = this;
    const own = store.blockOf(k);
    const next = store.blockOf(Math.min(k + 1, this.playback.last));
    const ahead = (next + 1) % store.blocks.length;
    let ready = true;
    for (const number of new Set([own, next, ahead])) {
      if (store.unpacked.has(number) || store.damaged.has(number)) continue;
      const needed = number === own || number === next;
      if (needed) ready = false;
      store.load(number).then(
        () => this.refresh(number),
        (error) => {
          if (needed) this.say(error.message);
          this.refresh(number);
        },
      );
    }
    element("waiting").hidden = ready;
    return ready;
  }

  refresh(number) {
    if (this.picked && number !== undefined)
      this.picked.path.add(number, this.store.unpacked.get(number) ?? { frames: [] });
    this.drawn = -1;
    this.dirty = true;
  }

  valuesOf(k, frame) {
    if (this.colour === "coordination") return this.coordination(k, frame);
    const values = fixedValues(this.colour, this.store);
    const own = new Float32Array(frame.place.length);
    if (values) for (let i = 0; i < own.length; ++i) own[i] = values[frame.place[i]];
    return own;
  }

  radiusOf(frame) {
    const radius = new Float32Array(frame.place.length);
    for (let i = 0; i < radius.length; ++i) radius[i] = this.store.radius[frame.place[i]];
    return radius;
  }

  // Radius and value by disk; frames with the same disks share the arrays if these do not change.
  columnsOf(k, frame) {
    const { known, colour } = this;
    if (known?.place === frame.place && known.colour === colour && colour !== "coordination") return known;
    this.known = { place: frame.place, colour, radius: this.radiusOf(frame), value: this.valuesOf(k, frame) };
    return this.known;
  }

  coordination(k, frame) {
    const found = this.counts.get(k);
    if (found) return found;
    const { axes, box } = this.head;
    const neighbours = {
      x: frame.x.slice(),
      y: frame.y.slice(),
      radius: this.radiusOf(frame),
      quantum: axes.map((axis) => axis.quantum),
      size: [box.width, box.height],
      periodic: axes.map((axis) => axis.periodic),
      offset: this.store.offset(k),
    };
    const zeros = new Float32Array(frame.place.length);
    this.counts.set(k, zeros);
    this.store.work({ neighbours }).then(({ count }) => {
      if (this.counts.size > 64) this.counts.clear();
      this.counts.set(k, count);
      if (this.drawn === k) this.drawn = -1;
      this.dirty = true;
    });
    return zeros;
  }

  upload(k, keep) {
    const frame = this.store.frame(k);
    if (!frame) return false;
    const steps = this.store.steps(k);
    const { radius, value } = this.columnsOf(k, frame);
    if (keep === 1 || k === this.playback.frame) {
      this.renderer.uploadImages(frame, steps, radius, value);
      this.perTime = 1 / steps.over;
      this.ahead = steps.d;
    }
    // For the shaders: no trail leads on from the place where a disk disappears.
    const marked = steps.gone.length ? radius.slice() : radius;
    for (const i of steps.gone) marked[i] = -marked[i];
    this.renderer.upload(k, frame, steps, marked, value, keep);
    return true;
  }

  trailFrames(k) {
    if (!element("trails").checked) return [];
    const length = Math.max(2, Math.min(mostTrail, Math.floor(4e6 / Math.max(1, this.head.disks))));
    const frames = [];
    for (let f = Math.max(0, k - length); f < k; ++f) if (this.store.frame(f)) frames.push(f);
    return frames;
  }

  draw() {
    const k = this.playback.frame;
    this.showTime();
    if (!this.ready(k)) return;
    this.dirty = false;
    const frame = this.store.frame(k);
    if (!frame) {
      this.say(this.store.damaged.get(this.store.blockOf(k)) ?? this.message);
      this.renderer.draw(-1, { ...this.look([]), images: false });
      this.drawn = -1;
      return;
    }
    if (!this.range) this.resetRange();
    const trail = this.trailFrames(k);
    if (this.drawn !== k) {
      this.upload(k, trail.length + 1);
      for (const f of trail) if (!this.renderer.slots.has(f)) this.upload(f, trail.length + 1);
      this.drawn = k;
      this.showPicked();
    }
    this.renderer.draw(k, this.look(trail));
    this.drawOver(frame);
    this.plots.draw(this.playback.time, this.colours);
  }

  look(trail) {
    const hex = (name) => parseInt(this.colours[name].slice(1), 16);
    return {
      camera: this.camera,
      density: this.density,
      largest: this.store.largest,
      ground: hex("ground"),
      ink: hex("ink"),
      range: this.range ?? [0, 1],
      bySpeed: this.colour === "speed",
      perTime: this.perTime ?? 1,
      least: this.store.id.length > manyDisks ? 0.75 : 1.6 * this.density,
      part: this.playback.part,
      time: this.playback.shownTime,
      images: element("images").checked,
      // An arrow for the fastest speed of the scale is as long as a fifteenth of the box.
      arrows: element("arrows").checked
        ? Math.max(this.head.box.width, this.head.box.height) / 15 / this.arrowSpeed
        : 0,
      trail,
    };
  }

  drawOver(frame) {
    const { camera, head, density, colours, playback, ahead } = this;
    const picked = this.picked?.path.mark(frame, playback, ahead);
    const time = shortNumber(playback.shownTime);
    drawOverlay(element("overlay"), density, camera, head, playback.frame, time, picked, colours);
  }

  showTime() {
    const { frame, last, shownTime } = this.playback;
    const time = shortNumber(shownTime);
    element("frame").value = frame;
    element("frame").setAttribute("aria-valuetext", `frame ${frame + 1} of ${last + 1}, t = ${time}`);
    element("time").textContent = `t = ${time}, ${frame + 1} of ${last + 1}`;
  }

  showPlaying() {
    element("play").textContent = this.playback.playing ? "Pause" : "Play";
    element("play").setAttribute("aria-pressed", String(this.playback.playing));
  }

  resetRange() {
    this.range = rangeOf(this.colour, this.store);
    this.arrowSpeed = rangeOf("speed", this.store)[1];
    this.renderer.setPalette(palette(this.colour));
    showLegend(this.colour, this.range, this.store);
  }

  // --- What is asked for

  changeView(change) {
    change(this.camera);
    this.dirty = true;
  }

  jump(frame) {
    this.playback.goTo(frame);
    this.dirty = true;
  }

  jumpToTime(time) {
    this.playback.goToTime(time);
    this.dirty = true;
  }

  togglePlay() {
    const { playback } = this;
    playback.playing = !playback.playing;
    if (playback.playing && playback.frame === playback.last) playback.goTo(0);
    this.showPlaying();
    this.dirty = true;
  }

  setColour(name) {
    this.colour = name;
    this.range = null;
    this.rangeChosen = false;
    this.drawn = -1;
    this.renderer.forget();
    this.dirty = true;
  }

  setRange() {
    const [low, high] = ["low", "high"].map((id) => element(id).valueAsNumber);
    if (Number.isFinite(low) && Number.isFinite(high) && low < high) {
      this.range = [low, high];
      this.rangeChosen = true;
    }
    this.dirty = true;
  }

  pickAt(px, py) {
    const frame = this.store.frame(this.playback.frame);
    if (!frame) return;
    const point = this.camera.toPlane(px, py);
    const i = diskAt(this.store, this.playback, this.ahead, point, 4 / this.camera.scale);
    this.pick(i < 0 ? -1 : frame.place[i]);
  }

  pickId(id) {
    this.pick(this.store.id.indexOf(id), id);
  }

  // place: in the table, -1 for none; id: the id asked for, if it is not in the table.
  pick(place, id) {
    this.dirty = true;
    if (place < 0) {
      this.picked = null;
      showFacts(id === undefined || Number.isNaN(id) ? [] : [["disk", `there is no disk ${id} here`]]);
      if (id === undefined) element("disk").value = "";
      return;
    }
    const picked = { place, path: new DiskPath(this.store, place) };
    this.picked = picked;
    element("disk").value = this.store.id[place];
    this.showPicked();
    const show = () => (this.dirty = true);
    picked.path.gather(this.playback.frame, () => this.picked === picked, show);
  }

  showPicked() {
    const k = this.playback.frame;
    const frame = this.store.frame(k);
    if (!this.picked || !frame) return;
    const { place, path } = this.picked;
    path.add(this.store.blockOf(k), this.store.unpacked.get(this.store.blockOf(k)));
    showFacts(factsOf(this.store, k, place, this.store.indexIn(frame, place)));
  }

  // For example #t=12.5&disk=7
  followHash() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const time = Number.parseFloat(asked.get("t")?.replace(" ", "+")); // in 1e+21 the + would be read as a space
    if (Number.isFinite(time)) this.playback.goToLink(time);
    this.dirty = true;
    const id = Number.parseInt(asked.get("disk"), 10);
    if (Number.isFinite(id)) this.pickId(id);
  }

  takeLink() {
    const id = this.picked ? `&disk=${this.store.id[this.picked.place]}` : "";
    history.replaceState(null, "", `#t=${this.playback.time}${id}`);
    navigator.clipboard?.writeText(location.href).catch(() => {});
    element("taken").textContent = "The address of the page is the link.";
  }

  takePicture() {
    this.draw();
    this.renderer.draw(this.playback.frame, this.look(this.trailFrames(this.playback.frame)));
    return pictureOf(this.canvas, element("overlay"));
  }

  async savePicture() {
    const name = `frame_${this.playback.frame + 1}.png`;
    saveAs(name, await this.takePicture());
    element("taken").textContent = `${name} is saved.`;
  }

  // For scripts: the positions of the disks of a frame, as the page draws them.
  async positions(k) {
    await this.store.load(this.store.blockOf(k));
    const { place, x, y } = this.store.frame(k);
    const [ax, ay] = this.head.axes;
    return {
      id: Array.from(place, (p) => this.store.id[p]),
      x: Array.from(x, (q) => q * ax.quantum),
      y: Array.from(y, (q) => q * ay.quantum),
    };
  }
}
