// Unpacks blocks of frames, packed as in io/view/view_block.hpp.

export function base64Bytes(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

const crcTable = new Uint32Array(256).map((_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
  return n;
});

export function crc32(bytes) {
  let crc = ~0;
  for (let i = 0; i < bytes.length; ++i) crc = crcTable[(crc ^ bytes[i]) & 255] ^ (crc >>> 8);
  return ~crc >>> 0;
}

export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The bytes packed in a text of the page. Throws an Error that says what is wrong with them.
export async function unpackText(text, length, check) {
  if (text === null || text.length < 4 * Math.ceil(length / 3)) throw new Error("the file ends too early");
  let packed;
  try {
    packed = base64Bytes(text);
  } catch {
    throw new Error("a letter is not base64");
  }
  if (packed.length !== length || crc32(packed) !== check) throw new Error("the checksum is wrong");
  return inflate(packed);
}

class BlockReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  word() {
    this.at += 4;
    const b = this.bytes;
    return (b[this.at - 4] | (b[this.at - 3] << 8) | (b[this.at - 2] << 16) | (b[this.at - 1] << 24)) >>> 0;
  }
  varint() {
    let value = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      const b = this.bytes[this.at++];
      value += (b & 127) * 2 ** shift;
      if (b < 128) return value;
    }
    throw new Error("the list of disks is wrong");
  }
  // Runs of places as pairs [begin, end).
  runs(places) {
    const runs = [];
    let end = 0;
    for (let left = this.varint(); left > 0; --left) {
      const begin = end + this.varint();
      end = begin + this.varint();
      if (end > places) throw new Error("the list of disks is wrong");
      runs.push([begin, end]);
    }
    return runs;
  }
}

// The places in all frames; frames with the same disks share an array.
function readPlaces(reader, frames, places) {
  const changes = [];
  const lists = [];
  const present = new Uint8Array(places);
  let list = new Uint32Array(0);
  for (let k = 0; k < frames; ++k) {
    const removed = reader.runs(places);
    const added = reader.runs(places);
    for (const [begin, end] of removed) present.fill(0, begin, end);
    for (const [begin, end] of added) present.fill(1, begin, end);
    if (removed.length || added.length) {
      let count = 0;
      for (let p = 0; p < places; ++p) count += present[p];
      list = new Uint32Array(count);
      for (let p = 0, i = 0; p < places; ++p) if (present[p]) list[i++] = p;
    }
    changes.push(added);
    lists.push(list);
  }
  return { changes, lists };
}

// One axis of all frames, as whole numbers.
function readAxis(residuals, bits, order, places, { changes, lists }) {
  const mask = 2 ** bits - 1;
  const last = new Int32Array(places);
  const before = new Int32Array(places);
  const second = order === 2;
  for (let k = 0, next = 0; k < lists.length; ++k) {
    for (const [begin, end] of changes[k]) {
      last.fill(0, begin, end);
      before.fill(0, begin, end);
    }
    const list = lists[k];
    for (let i = 0; i < list.length; ++i, ++next) {
      const p = list[i];
      const folded = residuals[next];
      const expected = second ? 2 * last[p] - before[p] : last[p];
      before[p] = last[p];
      last[p] = residuals[next] = (expected + ((folded >>> 1) ^ -(folded & 1))) & mask;
    }
    for (const [begin, end] of changes[k]) before.set(last.subarray(begin, end), begin);
  }
  return residuals;
}

// bits: of x and y; frames, residuals: the numbers expected. Returns the places in each frame, and x and y of all
// frames one after the other.
export function unpackBlock(bytes, bits, frames, residuals) {
  const reader = new BlockReader(bytes);
  if (reader.word() !== frames) throw new Error("the number of frames is wrong");
  const order = reader.word();
  const places = reader.word();
  const found = readPlaces(reader, frames, places);
  const planes = bits.map((b) => Math.ceil(b / 8));
  const size = found.lists.reduce((sum, list) => sum + list.length, 0);
  if (size !== residuals || reader.at + residuals * (planes[0] + planes[1]) !== bytes.length) {
    throw new Error("the length of the data is wrong");
  }
  const axes = [new Int32Array(residuals), new Int32Array(residuals)];
  let at = reader.at;
  for (let plane = 0; plane < 3; ++plane) {
    for (let axis = 0; axis < 2; ++axis) {
      if (plane >= planes[axis]) continue;
      const to = axes[axis];
      const shift = 8 * plane;
      if (plane === 0) for (let i = 0; i < residuals; ++i) to[i] = bytes[at + i];
      else for (let i = 0; i < residuals; ++i) to[i] |= bytes[at + i] << shift;
      at += residuals;
    }
  }
  const [x, y] = axes.map((column, axis) => readAxis(column, bits[axis], order, places, found));
  return { lists: found.lists, x, y };
}
