// Columns of series.csv and curves of analysis.h5, one below the other; those over time have a cursor at the present
// moment.
import { element, make, shortNumber } from "./format.js";

const rowHeight = 92;
const shownFirst = ["kinetic", "pressure", "g(r)"];

export class Plots {
  // head: of the page. jump: called with the time of a point that is clicked.
  constructor({ series, curves }, jump) {
    this.curves = [];
    this.shown = new Set();
    this.canvas = element("plot");
    this.canvas.addEventListener("pointerdown", (event) => {
      const curve = this.rows()[Math.floor(event.offsetY / rowHeight)];
      if (!curve?.inTime) return;
      const [from, to] = [curve.x[0], curve.x[curve.x.length - 1]];
      jump(from + (event.offsetX / this.canvas.clientWidth) * (to - from));
    });
    this.setSeries(series);
    curves.forEach((curve) => this.add(curve));
  }

  setSeries({ names, columns }) {
    names.slice(1).forEach((name, n) => this.add({ name, x: columns[0], y: columns[n + 1], inTime: true }));
  }

  // Adds a curve, or replaces that of the same name.
  add(curve) {
    if (curve.x.length < 2) return;
    const old = this.curves.find(({ name }) => name === curve.name);
    if (old) {
      Object.assign(old, curve);
      return;
    }
    element("plots").hidden = false;
    this.curves.push(curve);
    const box = make("input", undefined, { type: "checkbox" });
    // If velocities have no meaning, collisions are the only curve to show.
    box.checked = shownFirst.includes(curve.name) || (curve.name === "collisions" && !this.shown.size);
    const show = () => this.shown[box.checked ? "add" : "delete"](curve);
    show();
    box.addEventListener("change", () => {
      show();
      this.draw(this.now, this.colours);
    });
    const label = make("label");
    label.append(box, ` ${curve.name}`);
    element("columns").append(label);
  }

  rows() {
    return this.curves.filter((curve) => this.shown.has(curve));
  }

  draw(now, colours) {
    Object.assign(this, { now, colours });
    const rows = this.rows();
    this.canvas.style.height = `${rows.length * rowHeight}px`;
    const density = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    this.canvas.width = Math.max(1, Math.round(width * density));
    this.canvas.height = Math.max(1, Math.round(rows.length * rowHeight * density));
    const context = this.canvas.getContext("2d");
    context.scale(density, density);
    context.font = "11px system-ui, sans-serif";
    rows.forEach((curve, n) => this.drawRow(context, curve, n * rowHeight, width));
    const texts = rows
      .filter(({ inTime }) => inTime)
      .map(({ name, x, y }) => {
        const at = x.findLastIndex((t) => t <= now * (1 + 1e-12));
        return `${name} ${shortNumber(y[Math.max(0, at)] ?? NaN)}`;
      });
    element("plot-values").textContent = texts.join(", ");
  }

  drawRow(context, curve, top, width) {
    const values = curve.y.filter((value) => value !== null);
    const low = Math.min(...values);
    const high = Math.max(...values);
    const flat = !(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)));
    const bottom = top + rowHeight - 16;
    const from = curve.x[0];
    const span = curve.x[curve.x.length - 1] - from || 1;
    const x = (at) => ((at - from) / span) * (width - 2) + 1;
    const y = (value) =>
      flat ? (top + 16 + bottom) / 2 : bottom - ((value - low) / (high - low)) * (bottom - top - 16);
    context.strokeStyle = this.colours.line;
    context.strokeRect(0.5, top + 14.5, width - 1, bottom - top - 13);
    context.fillStyle = this.colours.ink;
    context.fillText(
      `${curve.name}  ${flat ? shortNumber(high) : `${shortNumber(low)} to ${shortNumber(high)}`}`,
      2,
      top + 11,
    );
    if (!curve.inTime) {
      const ends = `${shortNumber(from)} to ${shortNumber(from + span)}`;
      context.fillText(ends, width - 2 - context.measureText(ends).width, top + 11);
    }
    context.strokeStyle = this.colours.accent;
    context.beginPath();
    let pen = false;
    curve.y.forEach((value, n) => {
      if (value !== null) context[pen ? "lineTo" : "moveTo"](x(curve.x[n]), y(value));
      pen = value !== null;
    });
    context.stroke();
    if (!curve.inTime) return;
    context.strokeStyle = this.colours.heat;
    context.beginPath();
    context.moveTo(x(this.now), top + 14);
    context.lineTo(x(this.now), bottom + 2);
    context.stroke();
  }
}
