// Shared by the tests of the page: runs made by the program, and pages in Debian's Chromium with software rendering.
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const program = process.env.CAROM;

// A separate folder for a test file, with its runs.
export class Workshop {
  constructor() {
    this.folder = mkdtempSync(join(tmpdir(), "carom-browser-"));
  }
  async open() {
    this.browser = await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    });
  }
  async close() {
    await this.browser?.close();
    rmSync(this.folder, { recursive: true, force: true });
  }
  path(name) {
    return join(this.folder, name);
  }
  // Runs a scene; returns the folder of the run.
  run(name, scene) {
    writeFileSync(this.path(`${name}.toml`), scene);
    execFileSync(program, ["run", `${name}.toml`, "-o", name, "--quiet", "--force"], { cwd: this.folder });
    return this.path(name);
  }
  // Calls carom view; returns its output and the file.
  view(name, ...options) {
    const file = `${name}_${options.join("_").replace(/[^a-z0-9]/gi, "")}.html`;
    const done = spawnSync(program, ["view", name, "-o", file, "--force", ...options], {
      cwd: this.folder,
      encoding: "utf8",
    });
    if (done.status !== 0) throw new Error(done.stderr);
    return { file: this.path(file), err: done.stderr };
  }
  // Starts carom in the background; resolves with its process and the first line of its output, if there is one.
  async start(...words) {
    const child = spawn(program, words, { cwd: this.folder, stdio: ["ignore", "pipe", "inherit"] });
    const ended = new Promise((done) => child.on("exit", (status) => done(status)));
    const line = new Promise((done) => child.stdout.once("data", (data) => done(String(data).split("\n")[0])));
    return { child, ended, line };
  }
  // Opens a page file and waits until it shows a frame or an error. Returns its requests to the network, too.
  async show(file, hash = "") {
    const page = await this.browser.newPage({ viewport: { width: 1000, height: 700 } });
    const requests = [];
    const errors = [];
    page.on("request", (request) => requests.push(request.url()));
    page.on("pageerror", (error) => errors.push(error.message));
    await page.goto(file.startsWith("http:") ? file : `file://${file}${hash}`);
    const shown = () => window.carom?.drawn >= 0 || !document.getElementById("message").hidden;
    await page.waitForFunction(shown, undefined, { timeout: 60000 });
    return { page, requests, errors };
  }
}

// The frames in trajectory.xyz of a folder, without an incomplete one: time and, by id, x, y, radius, mass.
export function framesOf(folder) {
  const lines = readFileSync(join(folder, "trajectory.xyz"), "utf8").trimEnd().split("\n");
  const frames = [];
  for (let at = 0; at < lines.length;) {
    const count = Number(lines[at]);
    const time = Number(/Time=(\S+)/.exec(lines[at + 1])[1]);
    const disks = new Map();
    if (lines.length < at + 2 + count) break;
    for (const line of lines.slice(at + 2, at + 2 + count)) {
      const [, x, y, , , , , radius, mass, id] = line.split(/\s+/).map(Number);
      disks.set(id, { x, y, radius, mass });
    }
    frames.push({ time, disks });
    at += 2 + count;
  }
  return frames;
}

// The colours of points of the present picture, given in lengths of the box: [red, green, blue] for each.
export function coloursAt(page, points) {
  return page.evaluate(async (wanted) => {
    const viewer = window.carom;
    const image = await createImageBitmap(await viewer.takePicture());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return wanted.map(([x, y]) => {
      const [px, py] = viewer.camera.toPage(x, y);
      return [
        ...context
          .getImageData(Math.round(px * viewer.density), Math.round(py * viewer.density), 1, 1)
          .data.slice(0, 3),
      ];
    });
  }, points);
}

// Waits until the page has drawn frame k.
export const drawn = (page, k) =>
  page.waitForFunction((frame) => window.carom.drawn === frame && !window.carom.dirty, k);

// Disks at rest in known places, the last one on a periodic side.
export const restScene = (title = "disks at rest") => `title = ${JSON.stringify(title)}
[box]
width = 20.0
height = 12.0
left = "periodic"
right = "periodic"
[[disks]]
count = 4
positions = [[5, 3], [12, 9], [16, 4], [0.2, 6]]
velocities = [[0, 0], [0, 0], [0, 0], [1, 0]]
radius = 1.0
mass = 1.0
[run]
method = "exact"
t_end = 2.0
[output]
every = 0.5
trajectory = "xyz"
`;
