// Beside the page: unpacks blocks and counts neighbours, so that the page never waits.
import { unpackBlock, unpackText } from "./decode.js";

// How many disks lie within 1.1 contact distances of each; on periodic axes by the nearest image.
function coordination({ x, y, radius, quantum, size, periodic }) {
  const n = x.length;
  const reach = 1.1;
  let largest = 0;
  for (let i = 0; i < n; ++i) largest = Math.max(largest, radius[i]);
  const cells = size.map((s) => Math.max(1, Math.min(2048, Math.floor(s / (2 * reach * largest)))));
  const cellOf = (value, axis) =>
    Math.min(cells[axis] - 1, Math.max(0, Math.floor((value * quantum[axis] * cells[axis]) / size[axis])));
  const start = new Uint32Array(cells[0] * cells[1] + 1);
  const cell = new Uint32Array(n);
  for (let i = 0; i < n; ++i) ++start[(cell[i] = cellOf(y[i], 1) * cells[0] + cellOf(x[i], 0)) + 1];
  for (let c = 1; c < start.length; ++c) start[c] += start[c - 1];
  const filled = start.slice();
  const members = new Uint32Array(n);
  for (let i = 0; i < n; ++i) members[filled[cell[i]]++] = i;
  const count = new Float32Array(n);
  // The cells beside c on one axis, each once.
  const beside = (c, axis) => {
    const found = [c - 1, c, c + 1].map((b) => (periodic[axis] ? (b + cells[axis]) % cells[axis] : b));
    return [...new Set(found)].filter((b) => b >= 0 && b < cells[axis]);
  };
  const nearest = (d, axis) => (periodic[axis] ? d - size[axis] * Math.round(d / size[axis]) : d);
  for (let i = 0; i < n; ++i) {
    for (const row of beside(Math.floor(cell[i] / cells[0]), 1)) {
      for (const column of beside(cell[i] % cells[0], 0)) {
        const c = row * cells[0] + column;
        for (let m = start[c]; m < start[c + 1]; ++m) {
          const j = members[m];
          if (j <= i) continue;
          const dx = nearest((x[j] - x[i]) * quantum[0], 0);
          const dy = nearest((y[j] - y[i]) * quantum[1], 1);
          const near = reach * (radius[i] + radius[j]);
          if (dx * dx + dy * dy > near * near) continue;
          ++count[i];
          ++count[j];
        }
      }
    }
  }
  return count;
}

onmessage = async ({ data }) => {
  try {
    if (data.neighbours) {
      const count = coordination(data.neighbours);
      postMessage({ job: data.job, count }, [count.buffer]);
      return;
    }
    const bytes = await unpackText(data.text, data.length, data.check);
    if (!data.bits) {
      postMessage({ job: data.job, bytes }, [bytes.buffer]);
      return;
    }
    const block = unpackBlock(bytes, data.bits, data.frames, data.residuals);
    postMessage({ job: data.job, ...block }, [block.x.buffer, block.y.buffer]);
  } catch (error) {
    postMessage({ job: data.job, error: error.message || "they cannot be unpacked" });
  }
};
