// The picked disk, found by a point or by its id, and its path so far.

// The place at which disk i of a frame is drawn, in lengths: moved ahead by a part of its step to the next frame.
function placeOf({ head: { axes } }, frame, i, steps, part) {
  const ahead = (n) => (part > 0 ? part * steps[2 * i + n] : 0);
  return [frame.x[i] * axes[0].quantum + ahead(0), frame.y[i] * axes[1].quantum + ahead(1)];
}

// The index of the disk of the present frame that is drawn at a point, or -1; of several disks the one with the nearest
// centre, by the nearest image. steps: of the frame. slack: length by which a point may miss a small disk.
export function diskAt(store, { frame: k, part }, steps, [x, y], slack) {
  const { axes, box } = store.head;
  const frame = store.frame(k);
  const offset = store.offset(k);
  let found = -1;
  let best = Infinity;
  for (let i = 0; i < frame.place.length; ++i) {
    let [dx, dy] = placeOf(store, frame, i, steps, part);
    dx -= x;
    dy -= y;
    const rows = axes[1].periodic ? Math.round(dy / box.height) : 0;
    dy -= rows * box.height;
    dx -= rows * offset;
    if (axes[0].periodic) dx -= box.width * Math.round(dx / box.width);
    const distance = Math.hypot(dx, dy);
    if (distance < best && distance <= Math.max(store.radius[frame.place[i]], slack)) {
      best = distance;
      found = i;
    }
  }
  return found;
}

// Collects the path block by block; null where the disk does not exist.
export class DiskPath {
  constructor(store, place) {
    this.store = store;
    this.place = place;
    this.points = new Array(store.head.frames).fill(null);
    this.known = new Set();
  }
  add(number, { frames }) {
    if (this.known.has(number)) return;
    this.known.add(number);
    const { axes } = this.store.head;
    frames.forEach((frame, n) => {
      const i = this.store.indexIn(frame, this.place);
      if (i < 0) return;
      this.points[this.store.blocks[number].first + n] = [frame.x[i] * axes[0].quantum, frame.y[i] * axes[1].quantum];
    });
  }
  // The disk as drawn over the present frame: its radius, its path, and its place if it is in the frame.
  mark(frame, playback, steps) {
    const i = this.store.indexIn(frame, this.place);
    const place = i < 0 ? null : placeOf(this.store, frame, i, steps, playback.part);
    const path = [...this.points.slice(0, playback.frame + 1), place];
    return { radius: this.store.radius[this.place], place, path };
  }
  // Unpacks the blocks still needed up to frame k, and calls changed after each; stops when wanted() is no longer true.
  async gather(k, wanted, changed) {
    for (let number = this.store.blockOf(k); number >= 0 && wanted(); --number) {
      if (this.known.has(number)) continue;
      try {
        this.add(number, await this.store.load(number));
      } catch {
        this.known.add(number);
      }
      if (wanted()) changed();
    }
  }
}
