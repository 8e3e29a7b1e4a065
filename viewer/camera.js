// The part of the plane shown on the stage: converts lengths to pixels of the page.
export class Camera {
  constructor(box) {
    this.box = box;
    this.width = 1; // of the stage, in pixels of the page
    this.height = 1;
    this.fitted = true;
  }
  resize(width, height) {
    this.width = width;
    this.height = height;
    if (this.fitted) this.fit();
  }
  fit() {
    const margin = 28;
    const { width, height } = this.box;
    // Even on a stage with no room inside its margin the box has a pixel.
    const [across, along] = [this.width, this.height].map((pixels) => Math.max(1, pixels - 2 * margin));
    this.scale = Math.min(across / width, along / height);
    this.x = width / 2;
    this.y = height / 2;
    this.fitted = true;
  }
  toPage(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }
  toPlane(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }
  move(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.fitted = false;
  }
  // Zooms by a factor; this point of the page keeps its place.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toPlane(px, py);
    const fit = Math.min(this.width / this.box.width, this.height / this.box.height);
    this.scale = Math.max(fit / 20, Math.min(this.scale * factor, fit * 1e5));
    const [nx, ny] = this.toPlane(px, py);
    this.x += x - nx;
    this.y += y - ny;
    this.fitted = false;
  }
}
