// Connects the controls, the keys and the pointer with the page.
import { element } from "./format.js";

export const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

export function listenToControls(viewer) {
  const on = (id, kind, act) => element(id).addEventListener(kind, act);
  on("play", "click", () => viewer.togglePlay());
  on("back", "click", () => viewer.jump(viewer.playback.frame - 1));
  on("on", "click", () => viewer.jump(viewer.playback.frame + 1));
  on("frame", "input", () => viewer.jump(element("frame").valueAsNumber));
  on("speed", "change", () => (viewer.playback.speed = Number(element("speed").value)));
  on("loop", "change", () => (viewer.playback.loop = element("loop").checked));
  on("colour", "change", () => viewer.setColour(element("colour").value));
  for (const id of ["low", "high"]) on(id, "change", () => viewer.setRange());
  for (const id of ["arrows", "images", "smooth"]) on(id, "change", () => (viewer.dirty = true));
  on("trails", "change", () => viewer.setColour(viewer.colour));
  on("dark", "change", () => viewer.setTheme());
  on("disk", "change", () => viewer.pickId(element("disk").valueAsNumber));
  on("link", "click", () => viewer.takeLink());
  on("picture", "click", () => viewer.savePicture());
  on("fit", "click", () => viewer.changeView((camera) => camera.fit()));
  on("closer", "click", () => viewer.changeView((camera) => camera.zoom(1.5)));
  on("farther", "click", () => viewer.changeView((camera) => camera.zoom(1 / 1.5)));
  window.addEventListener("hashchange", () => viewer.followHash());
  document.addEventListener("keydown", (event) => followKey(viewer, event));
  listenToPointers(viewer);
}

function listenToPointers(viewer) {
  const { canvas } = viewer;
  const held = new Map();
  let moved = 0;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.offsetX, event.offsetY]);
    moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const from = held.get(event.pointerId);
    if (!from) return;
    const to = [event.offsetX, event.offsetY];
    const other = [...held.entries()].find(([id]) => id !== event.pointerId)?.[1];
    moved += Math.hypot(to[0] - from[0], to[1] - from[1]);
    held.set(event.pointerId, to);
    if (moved < 4) return;
    viewer.changeView((camera) => {
      const part = other ? 0.5 : 1;
      camera.move(part * (to[0] - from[0]), part * (to[1] - from[1]));
      if (!other) return;
      const apart = (a) => Math.max(1, Math.hypot(a[0] - other[0], a[1] - other[1]));
      camera.zoom(apart(to) / apart(from), (to[0] + other[0]) / 2, (to[1] + other[1]) / 2);
    });
  });
  const release = (event) => {
    if (held.delete(event.pointerId) && event.type === "pointerup" && moved < 4)
      viewer.pickAt(event.offsetX, event.offsetY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  const wheel = (event) => {
    event.preventDefault();
    viewer.changeView((camera) => camera.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY));
  };
  canvas.addEventListener("wheel", wheel, { passive: false });
}

function followKey(viewer, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const { tagName, type } = event.target;
  // Keys that a control uses itself are left to it.
  if (tagName === "SELECT" || (tagName === "INPUT" && type === "number")) return;
  const ticks = tagName === "BUTTON" || type === "checkbox" || tagName === "SUMMARY";
  if (event.key === " " && ticks) return;
  const slides = type === "range";
  const step = event.shiftKey ? 10 : 1;
  const tick = (id) => element(id).click();
  const pan = (dx, dy) =>
    document.activeElement === viewer.canvas && viewer.changeView((camera) => camera.move(dx, dy));
  const faster = (by) => {
    const at = speeds.indexOf(viewer.playback.speed) + by;
    if (at < 0 || at >= speeds.length) return;
    viewer.playback.speed = speeds[at];
    element("speed").value = speeds[at];
  };
  const acts = {
    " ": () => viewer.togglePlay(),
    ArrowLeft: () => viewer.jump(viewer.playback.frame - step),
    ArrowRight: () => viewer.jump(viewer.playback.frame + step),
    Home: () => viewer.jump(0),
    End: () => viewer.jump(viewer.playback.last),
    "<": () => faster(-1),
    ">": () => faster(1),
    "+": () => viewer.changeView((camera) => camera.zoom(1.25)),
    "-": () => viewer.changeView((camera) => camera.zoom(0.8)),
    0: () => viewer.changeView((camera) => camera.fit()),
    a: () => pan(40, 0),
    d: () => pan(-40, 0),
    w: () => pan(0, 40),
    s: () => pan(0, -40),
    l: () => tick("loop"),
    t: () => tick("trails"),
    v: () => tick("arrows"),
    p: () => !element("images-label").hidden && tick("images"),
    m: () => tick("smooth"),
  };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (!acts[key] || (slides && (key.startsWith("Arrow") || key === "Home" || key === "End"))) return;
  event.preventDefault();
  acts[key]();
}
