// Works beside the page: unpacks blocks and counts neighbours, so that the page never waits.
import { unpackBlock, unpackText } from "./decode.js";

// The number of disks within 1.1 contact distances of each disk; on periodic axes by the nearest image. offset:
// displacement of the images above, in a sheared box.
function coordination({ x, y, radius, quantum, size, periodic, offset }) {
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
  // The cells next to c along one axis, each of them once.
  const beside = (c, axis) => {
    const found = [c - 1, c, c + 1].map((b) => (periodic[axis] ? (b + cells[axis]) % cells[axis] : b));
    return [...new Set(found)].filter((b) => b >= 0 && b < cells[axis]);
  };
  // The columns next to disk i in a row; across the bottom or the top of a sheared box those next to its displaced
  // image.
  const columnsBeside = (i, row) => {
    const own = Math.floor(cell[i] / cells[0]);
    if (offset && cells[1] < 3) return [...Array(cells[0]).keys()]; // a row may be on both sides
    if (!offset || Math.abs(row - own) <= 1) return beside(cell[i] % cells[0], 0);
    const image = x[i] * quantum[0] + (row < own ? -offset : offset);
    return beside(cellOf((image - size[0] * Math.floor(image / size[0])) / quantum[0], 0), 0);
  };
  const turns = (d, axis) => (periodic[axis] ? -Math.round(d / size[axis]) : 0);
  for (let i = 0; i < n; ++i) {
    for (const row of beside(Math.floor(cell[i] / cells[0]), 1)) {
      for (const column of columnsBeside(i, row)) {
        const c = row * cells[0] + column;
        for (let m = start[c]; m < start[c + 1]; ++m) {
          const j = members[m];
          if (j <= i) continue;
          let dy = (y[j] - y[i]) * quantum[1];
          const rows = turns(dy, 1);
          dy += rows * size[1];
          let dx = (x[j] - x[i]) * quantum[0] + rows * offset;
          dx += turns(dx, 0) * size[0];
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
