// The run as the page holds it: the head, the table of disks, and the blocks of frames that were unpacked last.
import { element } from "./format.js";
import { offsetAt } from "./shear.js";

const mostBytes = 320e6; // for unpacked blocks

// The text of a data block, or null if the file breaks off before it. The page of a run that is going on asks its
// server for it (live.js).
const textOf = (id) => element(id)?.textContent ?? window.caromLive?.textOf(id) ?? null;

export class Store {
  constructor(head) {
    this.head = head;
    this.blocks = [];
    this.addBlocks(head.blocks);
    this.unpacked = new Map(); // by number of the block, the one used last at the end
    this.asked = new Map();
    this.damaged = new Map(); // errors of damaged blocks
    this.bytes = 0;
    this.jobs = new Map();
    this.url = URL.createObjectURL(new Blob([textOf("worker")], { type: "text/javascript" }));
    this.worker = new Worker(this.url);
    this.worker.onmessage = ({ data }) => {
      const { done, failed } = this.jobs.get(data.job);
      this.jobs.delete(data.job);
      if (data.error) failed(new Error(data.error));
      else done(data);
    };
    this.lastJob = 0;
  }

  addBlocks(blocks) {
    for (const [first, frames, residuals, length, check] of blocks)
      this.blocks.push({ first, frames, residuals, length, check });
  }

  work(message) {
    const job = ++this.lastJob;
    return new Promise((done, failed) => {
      this.jobs.set(job, { done, failed });
      this.worker.postMessage({ job, ...message });
    });
  }

  // The times of frames; radius, mass, id and group by place. Throws if the table is damaged.
  async readTable() {
    const { head } = this;
    const { bytes } = await this.work({ text: textOf("table"), length: head.table.bytes, check: head.table.check });
    let at = 0;
    const take = (Kind, count) => {
      const part = new Kind(bytes.buffer.slice(at, at + count * Kind.BYTES_PER_ELEMENT));
      at += part.byteLength;
      return part;
    };
    this.times = take(Float64Array, head.frames);
    this.radius =
      head.radius === null ? take(Float64Array, head.disks) : new Float64Array(head.disks).fill(head.radius);
    this.mass = head.mass === null ? take(Float64Array, head.disks) : new Float64Array(head.disks).fill(head.mass);
    this.id = take(Uint32Array, head.disks);
    this.group = head.grouped ? take(Uint32Array, head.disks) : new Uint32Array(head.disks).fill(head.group);
    this.largest = this.radius.reduce((a, b) => Math.max(a, b), 0);
  }

  // The number of the block that contains frame k.
  blockOf(k) {
    let low = 0;
    let high = this.blocks.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.blocks[middle].first <= k) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  frames(number) {
    const { first, frames } = this.blocks[number];
    return frames === 1 ? `frame ${first + 1} is` : `frames ${first + 1} to ${first + frames} are`;
  }

  // A sentence about the first block that is missing in the file, wholly or in part; empty if the file is whole.
  missing() {
    if (window.caromLive) return "";
    for (let b = 0; b < this.blocks.length; ++b) {
      const text = textOf(`block${b}`);
      if (text === null || text.length < 4 * Math.ceil(this.blocks[b].length / 3)) {
        return `This file is incomplete: ${this.frames(b)} missing, and all that follow.`;
      }
    }
    return element("end") ? "" : "This file is incomplete.";
  }

  // Unpacks a block unless that was done. Rejects with a sentence if it is damaged.
  load(number) {
    if (this.unpacked.has(number)) {
      const block = this.unpacked.get(number);
      this.unpacked.delete(number);
      this.unpacked.set(number, block);
      return Promise.resolve(block);
    }
    if (!this.asked.has(number)) {
      this.asked.set(
        number,
        this.unpack(number).finally(() => this.asked.delete(number)),
      );
    }
    return this.asked.get(number);
  }

  async unpack(number) {
    const block = this.blocks[number];
    const { length, check, frames, residuals } = block;
    const bits = this.head.axes.map((axis) => axis.bits);
    let found;
    try {
      found = await this.work({ text: await textOf(`block${number}`), length, check, frames, residuals, bits });
    } catch (error) {
      const sentence = `${this.frames(number)} damaged: ${error.message}.`;
      this.damaged.set(number, sentence[0].toUpperCase() + sentence.slice(1));
      throw new Error(this.damaged.get(number));
    }
    let at = 0;
    const list = found.lists.map((place) => {
      const frame = { place, x: found.x.subarray(at, at + place.length), y: found.y.subarray(at, at + place.length) };
      at += place.length;
      return frame;
    });
    const made = { frames: list, bytes: 8 * residuals };
    this.unpacked.set(number, made);
    this.bytes += made.bytes;
    for (const [old, { bytes }] of this.unpacked) {
      if (this.bytes <= mostBytes || this.unpacked.size <= 3) break;
      this.unpacked.delete(old);
      this.bytes -= bytes;
    }
    return made;
  }

  // Frame k if it is unpacked, otherwise null.
  frame(k) {
    if (k < 0 || k >= this.head.frames) return null;
    const b = this.blockOf(k);
    return this.unpacked.get(b)?.frames[k - this.blocks[b].first] ?? null;
  }

  // The index in a frame of the disk at this place of the table, or -1 if it is not in the frame.
  indexIn(frame, place) {
    let low = 0;
    let high = frame.place.length - 1;
    while (low <= high) {
      const middle = (low + high) >> 1;
      if (frame.place[middle] === place) return middle;
      if (frame.place[middle] < place) low = middle + 1;
      else high = middle - 1;
    }
    return -1;
  }

  // The displacement of the images above a sheared box in frame k.
  offset(k) {
    return offsetAt(this.head.box, this.times[k]);
  }

  // The displacement from disk i of frame a to disk j of frame b along an axis, by the nearest image; in lengths.
  // offset: of the images above in frame b.
  step(axis, a, i, b, j, offset) {
    const { bits, periodic, quantum } = this.head.axes[axis];
    let d = axis === 0 ? b.x[j] - a.x[i] : b.y[j] - a.y[i];
    if (axis === 0 && offset) {
      const dy = b.y[j] - a.y[i];
      const half = 2 ** (this.head.axes[1].bits - 1);
      const rows = dy >= half ? -1 : dy < -half ? 1 : 0;
      d += Math.round((rows * offset) / quantum);
    }
    if (periodic) d = (d << (32 - bits)) >> (32 - bits);
    return d * quantum;
  }

  // The displacement of each disk of frame k to the next frame, x and y in turn; divided by the time `over` it is the
  // mean velocity. In the last frame, and for disks that are gone in the next one (indices in `gone`), it is that of
  // the step before. In a sheared box it is the displacement of the image whose disk is in frame k, which has the
  // velocity of the disk there.
  steps(k) {
    const frame = this.frame(k);
    const next = this.frame(k + 1);
    const before = this.frame(k - 1);
    const d = new Float32Array(2 * frame.place.length);
    const gone = [];
    const offsetAhead = next ? this.offset(k + 1) : 0;
    const offsetBack = before ? this.offset(k - 1) : 0;
    const span = (f) => this.times[f + 1] - this.times[f];
    const over = (next && span(k)) || (before && span(k - 1)) || 1;
    const same = (other, i) => (other.place[i] === frame.place[i] ? i : this.indexIn(other, frame.place[i]));
    for (let i = 0; i < frame.place.length; ++i) {
      let other = next;
      let j = next ? same(next, i) : -1;
      if (j < 0) gone.push(i);
      if (j < 0 && before) {
        other = before;
        j = same(before, i);
      }
      if (j < 0) continue;
      const sign = other === next ? 1 : -over / (span(k - 1) || over);
      const offset = other === next ? offsetAhead : offsetBack;
      d[2 * i] = sign * this.step(0, frame, i, other, j, offset);
      d[2 * i + 1] = sign * this.step(1, frame, i, other, j, offset);
    }
    return { d, gone, over };
  }
}
