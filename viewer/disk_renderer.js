// Draws all disks of a frame in one call of WebGL2: each is a square from which the shader keeps the disk. Squares of
// small disks are points, which cost one vertex each; points have a largest size, so squares of large disks are
// instances of four vertices.
import { parts } from "./colours.js";
import { offsetAt } from "./shear.js";

const head = `#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in int ix;
layout(location = 1) in int iy;
layout(location = 2) in vec2 d;
layout(location = 3) in float radius;
layout(location = 4) in float value;
uniform vec2 quantum, shift, centre, size;
uniform float scale, part, low, perSpan, reach, least;
uniform bool bySpeed;
uniform sampler2D palette;
out vec4 colour;
vec2 place() { return (vec2(float(ix), float(iy)) * quantum + shift + part * d - centre) * scale; }
vec4 colourOf() {
  // The square of a length may be more, or less, than a float holds: a part of the scale first.
  float at = bySpeed ? length(d * perSpan) - low : (value - low) * perSpan;
  return texture(palette, vec2((clamp(at, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5));
}
`;
const pointShader = `${head}
out float rim;
void main() {
  rim = max(abs(radius) * scale, least);
  colour = colourOf();
  gl_PointSize = 2.0 * (rim + 1.0);
  gl_Position = vec4(place() * 2.0 / size, 0.0, 1.0);
}`;
const diskShader = `${head}
out vec2 from;
out float rim;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  rim = max(abs(radius) * scale, least);
  from = corner * (rim + 1.0);
  colour = colourOf();
  gl_Position = vec4((place() + from) * 2.0 / size, 0.0, 1.0);
}`;
const diskPaint = (points) => `#version 300 es
precision highp float;
in vec4 colour;
${points ? "" : "in vec2 from;"}
in float rim;
uniform float strength;
out vec4 pixel;
void main() {
  ${points ? "vec2 from = (gl_PointCoord * 2.0 - 1.0) * (rim + 1.0);" : ""}
  float r = length(from);
  float cover = clamp(rim - r + 0.5, 0.0, 1.0) * strength;
  float edge = rim > 4.0 ? smoothstep(rim - 2.0, rim - 0.5, r) * 0.35 : 0.0;
  pixel = vec4(colour.rgb * (1.0 - edge), 1.0) * cover;
}`;
const lineShader = `${head}
uniform vec3 ink;
uniform bool inked;
void main() {
  colour = inked ? vec4(ink, 1.0) : colourOf();
  bool on = gl_VertexID == 1 && (inked || radius > 0.0);
  gl_Position = vec4((place() + (on ? d * reach * scale : vec2(0.0))) * 2.0 / size, 0.0, 1.0);
}`;
const linePaint = `#version 300 es
precision highp float;
in vec4 colour;
uniform float strength;
out vec4 pixel;
void main() { pixel = vec4(colour.rgb, 1.0) * strength; }`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(made) || "shaders do not link");
  const at = {};
  for (let u = 0; u < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++u) {
    const { name } = gl.getActiveUniform(made, u);
    at[name] = gl.getUniformLocation(made, name);
  }
  return { made, at };
}

// The columns of some disks on the graphics card.
class DiskBuffers {
  constructor(gl) {
    this.gl = gl;
    this.count = 0;
    this.held = [];
    this.buffers = [0, 1, 2, 3, 4].map(() => gl.createBuffer());
    this.array = this.arrayOf(1);
    this.pointArray = this.arrayOf(0);
  }
  // Columns that advance with each instance (1) or with each vertex (0).
  arrayOf(divisor) {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    this.buffers.forEach((buffer, column) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(column);
      if (column < 2) gl.vertexAttribIPointer(column, 1, gl.INT, 0, 0);
      else gl.vertexAttribPointer(column, column === 2 ? 2 : 1, gl.FLOAT, false, 0, 0);
      gl.vertexAttribDivisor(column, divisor);
    });
    return array;
  }
  // Does nothing if these data are on the card already.
  fill(column, data) {
    if (this.held[column] === data) return;
    this.held[column] = data;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[column]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, data, this.gl.DYNAMIC_DRAW);
  }
}

export class DiskRenderer {
  // tell: gets a sentence about the graphics card for the page; it is empty when the card is back, and then all data
  // have to be uploaded again.
  constructor(canvas, axes, box, tell) {
    const gl = canvas.getContext("webgl2", { antialias: false, premultipliedAlpha: true, alpha: false });
    if (!gl) throw new Error("This browser has no WebGL2, which draws the disks.");
    Object.assign(this, { gl, canvas, axes, box });
    this.begin();
    // The graphics card was reset, or the browser has given it to other pages.
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // asks the browser to restore it as soon as it can
      tell("This page has lost the graphics card. Load it again if the disks do not come back.");
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.begin();
      this.setPalette(this.palette);
      tell("");
    });
  }

  begin() {
    const { gl } = this;
    this.disks = program(gl, diskShader, diskPaint(false));
    this.points = program(gl, pointShader, diskPaint(true));
    this.largestPoint = Math.min(64, gl.getParameter(gl.ALIASED_POINT_SIZE_RANGE)[1]);
    this.lines = program(gl, lineShader, linePaint);
    this.slots = new Map(); // buffers by frame: the present one, and those of trails
    // Images of disks that reach over a periodic side: in the row of the box, and from the rows above and below a
    // sheared box, without their displacement.
    this.images = [0, 1, -1].map((row) => ({ row, slot: new DiskBuffers(gl) }));
    this.colours = gl.createTexture();
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  setPalette(bytes) {
    const { gl } = this;
    this.palette = bytes;
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }

  // Uploads a frame; radius and value are by disk of the frame. Keeps at most `keep` frames.
  upload(k, frame, steps, radius, value, keep) {
    let slot = this.slots.get(k);
    if (!slot) {
      const old = this.slots.size >= keep ? this.slots.keys().next().value : undefined;
      slot = old === undefined ? new DiskBuffers(this.gl) : this.slots.get(old);
      this.slots.delete(old);
    }
    this.slots.delete(k);
    this.slots.set(k, slot);
    slot.count = frame.place.length;
    [frame.x, frame.y, steps.d, radius, value].forEach((data, column) => slot.fill(column, data));
  }

  // Uploads the images that disks reaching over a periodic side have at the other side.
  uploadImages(frame, steps, radius, value) {
    const { axes } = this;
    const sheared = Boolean(this.box.shear);
    const found = this.images.map(() => [[], [], [], [], []]);
    const turns = axes.map((axis) => (axis.periodic ? 2 ** axis.bits : 0));
    const over = (at, r, axis) => {
      if (!turns[axis]) return 0;
      const reach = r / axes[axis].quantum;
      return at < reach ? turns[axis] : at > turns[axis] - reach ? -turns[axis] : 0;
    };
    const add = (i, sx, sy) => {
      const columns = found[!sheared || !sy ? 0 : sy > 0 ? 1 : 2];
      const row = [frame.x[i] + sx, frame.y[i] + sy, [steps.d[2 * i], steps.d[2 * i + 1]], radius[i], value[i]];
      row.forEach((entry, column) => (column === 2 ? columns[2].push(...entry) : columns[column].push(entry)));
    };
    if (turns[0] || turns[1]) {
      for (let i = 0; i < frame.place.length; ++i) {
        const sx = over(frame.x[i], radius[i], 0);
        const sy = over(frame.y[i], radius[i], 1);
        if (sx) add(i, sx, 0);
        // A displaced image may reach over either side.
        if (sy) for (const turn of sheared ? [-turns[0], 0, turns[0]] : sx ? [0, sx] : [0]) add(i, turn, sy);
      }
    }
    this.images.forEach(({ slot }, n) => {
      slot.count = found[n][0].length;
      found[n].forEach((data, column) => slot.fill(column, column < 2 ? new Int32Array(data) : new Float32Array(data)));
    });
  }

  // The buffers then belong to no frame, and are used by the next frames. Surplus ones stay on the card until the
  // browser collects them; to the browser they are only a few bytes.
  forget() {
    this.slots = new Map([...this.slots.values()].map((slot, n) => [-2 - n, slot]));
  }

  use({ made, at }, look) {
    const { gl, canvas, axes } = this;
    gl.useProgram(made);
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.uniform2f(at.quantum, axes[0].quantum, axes[1].quantum);
    gl.uniform2f(at.centre, look.camera.x, look.camera.y);
    const edge = made === this.points.made ? this.largestPoint : 0;
    gl.viewport(-edge, -edge, canvas.width + 2 * edge, canvas.height + 2 * edge);
    gl.uniform2f(at.size, canvas.width + 2 * edge, canvas.height + 2 * edge);
    const [low, high] = look.range;
    const perSpan = 1 / Math.max(high - low, 1e-300);
    gl.uniform1f(at.low, look.bySpeed ? low * perSpan : low);
    gl.uniform1f(at.perSpan, look.bySpeed ? look.perTime * perSpan : perSpan);
    gl.uniform2f(at.shift, 0, 0);
    gl.uniform1f(at.scale, look.camera.scale * look.density);
    gl.uniform1f(at.least, look.least);
    gl.uniform1f(at.part, look.part);
    gl.uniform1f(at.strength, 1);
    gl.uniform1i(at.bySpeed, look.bySpeed ? 1 : 0);
    return at;
  }

  // With periodic sides only the inside of the box is drawn, unless periodic images are wanted.
  clip(look) {
    const { gl, canvas, box } = this;
    const [left, top] = look.camera.toPage(0, box.height);
    const [right, bottom] = look.camera.toPage(box.width, 0);
    const [px, py] = this.axes.map((axis) => axis.periodic);
    const x0 = px ? Math.round(left * look.density) : 0;
    const x1 = px ? Math.round(right * look.density) : canvas.width;
    const y0 = py ? canvas.height - Math.round(bottom * look.density) : 0;
    const y1 = py ? canvas.height - Math.round(top * look.density) : canvas.height;
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(x0, y0, Math.max(1, x1 - x0), Math.max(1, y1 - y0)); // at least a pixel, however long the box is
  }

  // A point is dropped if its centre is out of view, so the view is enlarged by the size of a point; see use().
  useDisks(look) {
    this.asPoints =
      2 * (Math.max(look.least, look.largest * look.camera.scale * look.density) + 1) <= this.largestPoint;
    return this.use(this.asPoints ? this.points : this.disks, look);
  }

  drawDisks(slot) {
    const { gl } = this;
    gl.bindVertexArray(this.asPoints ? slot.pointArray : slot.array);
    if (!slot.count) return;
    if (this.asPoints) gl.drawArrays(gl.POINTS, 0, slot.count);
    else gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, slot.count);
  }

  // look: camera, density (device pixels in a page pixel), largest (radius of all disks), ground, ink, range, bySpeed,
  // perTime, time, part (of the way to the next frame), images, arrows (time ahead that they show, 0: none), trail
  // (uploaded frames, oldest first).
  draw(k, look) {
    const { gl } = this;
    const slot = this.slots.get(k);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...parts(look.ground).map((c) => c / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!slot) return;
    if (look.images) this.drawPeriodicImages(slot, look);
    this.clip(look);
    this.drawTrail(look);
    const at = this.useDisks(look);
    this.drawDisks(slot);
    for (const image of this.images) {
      gl.uniform2f(at.shift, image.row * offsetAt(this.box, look.time), 0);
      this.drawDisks(image.slot);
    }
    if (look.arrows) this.drawLines(slot, look, { reach: look.arrows * look.perTime, ink: look.ink });
    gl.disable(gl.SCISSOR_TEST);
  }

  drawPeriodicImages(slot, look) {
    const { gl, box } = this;
    const at = this.useDisks(look);
    gl.uniform1f(at.strength, 0.3);
    const [xs, ys] = this.axes.map((axis) => (axis.periodic ? [-1, 0, 1] : [0]));
    const offset = offsetAt(box, look.time);
    for (const j of ys) {
      // In a displaced row one more image fills the gap.
      const more = Math.sign(j * offset) * -2;
      for (const i of more ? [...xs, more] : xs) {
        if (i === 0 && j === 0) continue;
        gl.uniform2f(at.shift, i * box.width + j * offset, j * box.height);
        this.drawDisks(slot);
      }
    }
    this.clip(look);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.disable(gl.SCISSOR_TEST);
  }

  drawLines(slot, look, { reach, ink, strength = 1 }) {
    const { gl } = this;
    const at = this.use(this.lines, { ...look, part: strength < 1 ? 0 : look.part });
    gl.uniform1f(at.reach, reach);
    gl.uniform1f(at.strength, strength);
    gl.uniform1i(at.inked, ink === undefined ? 0 : 1);
    if (ink !== undefined) gl.uniform3f(at.ink, ...parts(ink).map((c) => c / 255));
    gl.bindVertexArray(slot.array);
    if (slot.count) gl.drawArraysInstanced(gl.LINES, 0, 2, slot.count);
  }

  drawTrail(look) {
    look.trail.forEach((k, n) => {
      const slot = this.slots.get(k);
      if (slot) this.drawLines(slot, look, { reach: 1, strength: (0.9 * (n + 1)) / (look.trail.length + 1) });
    });
  }
}
