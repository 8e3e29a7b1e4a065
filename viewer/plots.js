// Columns of series.csv against time, one below the other, under the cursor of the present moment.
import { element, make, shortNumber } from "./format.js";

const rowHeight = 92;

export class Plots {
  constructor({ names, columns }, jump) {
    this.names = names;
    this.columns = columns;
    this.time = columns[0] ?? [];
    this.shown = new Set();
    if (names.length < 2 || this.time.length < 2) return;
    element("plots").hidden = false;
    const first = ["kinetic", "pressure", "collisions"].filter((name) => names.includes(name)).slice(0, 2);
    names.slice(1).forEach((name, n) => {
      const label = make("label");
      const box = make("input", undefined, { type: "checkbox" });
      box.checked = first.length ? first.includes(name) : n === 0;
      if (box.checked) this.shown.add(n + 1);
      box.addEventListener("change", () => {
        if (box.checked) this.shown.add(n + 1);
        else this.shown.delete(n + 1);
        this.draw(this.now, this.colours);
      });
      label.append(box, ` ${name}`);
      element("columns").append(label);
    });
    this.canvas = element("plot");
    this.canvas.addEventListener("pointerdown", (event) => {
      const from = this.time[0];
      const part = event.offsetX / this.canvas.clientWidth;
      jump(from + part * (this.time[this.time.length - 1] - from));
    });
  }

  draw(now, colours) {
    Object.assign(this, { now, colours });
    if (!this.canvas) return;
    const rows = [...this.shown].sort((a, b) => a - b);
    this.canvas.style.height = `${rows.length * rowHeight}px`;
    const density = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth;
    this.canvas.width = Math.max(1, Math.round(width * density));
    this.canvas.height = Math.max(1, Math.round(rows.length * rowHeight * density));
    const context = this.canvas.getContext("2d");
    context.scale(density, density);
    context.font = "11px system-ui, sans-serif";
    rows.forEach((column, n) => this.drawRow(context, column, n * rowHeight, width));
    const at = this.time.findLastIndex((t) => t <= now * (1 + 1e-12));
    const texts = rows.map((column) => `${this.names[column]} ${shortNumber(this.columns[column][Math.max(0, at)] ?? NaN)}`);
    element("plot-values").textContent = texts.join(", ");
  }

  drawRow(context, column, top, width) {
    const values = this.columns[column];
    let low = Infinity;
    let high = -Infinity;
    for (const value of values) {
      if (value === null) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const flat = !(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)));
    const bottom = top + rowHeight - 16;
    const from = this.time[0];
    const span = this.time[this.time.length - 1] - from || 1;
    const x = (t) => ((t - from) / span) * (width - 2) + 1;
    const y = (value) => (flat ? (top + 16 + bottom) / 2 : bottom - ((value - low) / (high - low)) * (bottom - top - 16));
    context.strokeStyle = this.colours.line;
    context.strokeRect(0.5, top + 14.5, width - 1, bottom - top - 13);
    context.fillStyle = this.colours.ink;
    context.fillText(`${this.names[column]}  ${flat ? shortNumber(high) : `${shortNumber(low)} to ${shortNumber(high)}`}`, 2, top + 11);
    context.strokeStyle = this.colours.accent;
    context.beginPath();
    let pen = false;
    values.forEach((value, n) => {
      if (value === null) pen = false;
      else if (pen) context.lineTo(x(this.time[n]), y(value));
      else context.moveTo(x(this.time[n]), y(value)), (pen = true);
    });
    context.stroke();
    context.strokeStyle = this.colours.heat;
    context.beginPath();
    context.moveTo(x(this.now), top + 14);
    context.lineTo(x(this.now), bottom + 2);
    context.stroke();
  }
}
