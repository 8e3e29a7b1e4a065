// The drawings over the disks: the sides of the box, sources, the picked disk and its path, the scale bar, the time.
import { counted, roundBelow, shortNumber } from "./format.js";

const sideNames = ["left", "right", "bottom", "top"];

// The ends of a side, in lengths.
function sideEnds(side, { width, height }, inset = 0) {
  return [
    [inset, 0, inset, height],
    [width - inset, 0, width - inset, height],
    [0, inset, width, inset],
    [0, height - inset, width, height - inset],
  ][side];
}

export function sideSentence({ box, insets, sources, obstacles, walls }) {
  const word = (kind, s) => `${insets[s] ? "moving " : ""}${box.thermal[s] ? "thermal " : ""}${kind}`;
  const words = box.sides.map((kind, s) => `${sideNames[s]} ${word(kind, s)}`);
  const keys = [
    [box.sides.includes("wall") || walls.some((wall) => !wall[4]), "walls are whole lines"],
    [box.thermal.includes(true), "thermal ones red"],
    [box.sides.includes("periodic"), "periodic sides dashed"],
    [box.sides.includes("sink") || walls.some((wall) => wall[4]), "sinks dotted"],
    [sources.length, "sources green"],
    [obstacles.length, `${counted(obstacles.length, "obstacle")} grey`],
  ];
  return `Sides: ${words.join(", ")}. Drawn: ${keys.flatMap(([there, text]) => (there ? [text] : [])).join(", ")}.`;
}

// Until restore() nothing is drawn outside the box.
function clipToBox(context, camera, { width, height }) {
  context.save();
  context.beginPath();
  context.rect(...camera.toPage(0, height), width * camera.scale, height * camera.scale);
  context.clip();
}

// Draws the obstacles inside the box, as in movies; those that reach over a periodic side are drawn twice.
function drawObstacles(context, camera, { box, axes, obstacles }, colours) {
  clipToBox(context, camera, box);
  context.fillStyle = colours.faint;
  context.beginPath();
  const turns = (axis, at, r, size) => (!axis.periodic ? [0] : at < r ? [0, size] : at > size - r ? [0, -size] : [0]);
  for (const [x, y, r] of obstacles) {
    for (const dx of turns(axes[0], x, r, box.width)) {
      for (const dy of turns(axes[1], y, r, box.height)) {
        const [px, py] = camera.toPage(x + dx, y + dy);
        context.moveTo(px + r * camera.scale, py);
        context.arc(px, py, r * camera.scale, 0, 2 * Math.PI);
      }
    }
  }
  context.fill();
  context.restore();
}

function drawWall(context, camera, [x0, y0, x1, y1], kind, colour) {
  context.strokeStyle = colour;
  // Half of a side's line covers disks, so it is thinner in a thin box.
  const thin = camera.scale * Math.min(camera.box.width, camera.box.height);
  context.lineWidth = Math.min(kind === "wall" ? 3 : 1.5, thin / 8);
  context.setLineDash(kind === "periodic" ? [8, 6] : kind === "sink" ? [2, 5] : []);
  context.beginPath();
  context.moveTo(...camera.toPage(x0, y0));
  context.lineTo(...camera.toPage(x1, y1));
  context.stroke();
}

// Draws an inner wall displaced by shift, and its images across periodic sides, as far as they are inside the box.
function drawMovingWall(context, camera, { box, axes }, [x0, y0, x1, y1], shift, ...look) {
  const turns = (k, at, size) => {
    const turn = axes[k].periodic ? Math.floor((at + shift[k]) / size) : 0;
    return (axes[k].periodic ? [-1, 0, 1] : [0]).map((n) => shift[k] + (n - turn) * size);
  };
  clipToBox(context, camera, box);
  for (const x of turns(0, x0, box.width)) {
    for (const y of turns(1, y0, box.height)) {
      drawWall(context, camera, [x0 + x, y0 + y, x1 + x, y1 + y], ...look);
    }
  }
  context.restore();
}

function drawSides(context, camera, head, frame, colours) {
  const { box } = head;
  for (let s = 0; s < 4; ++s) {
    const ends = sideEnds(s, box, head.insets[s]?.[frame]);
    drawWall(context, camera, ends, box.sides[s], box.thermal[s] ? colours.heat : colours.ink);
  }
  for (const wall of head.walls) {
    const shift = head.shifts[wall[5]]?.[frame];
    // A sink along a side or another wall is an opening in it.
    const draw = (...look) =>
      shift ? drawMovingWall(context, camera, head, wall, shift, ...look) : drawWall(context, camera, wall, ...look);
    if (wall[4]) draw("wall", colours.ground);
    draw(wall[4] ? "sink" : "wall", colours.ink);
  }
  context.setLineDash([4, 3]);
  context.strokeStyle = "#1a9850";
  context.lineWidth = 2;
  for (const source of head.sources) {
    const [x0, y0, x1, y1] = source.region ?? sideEnds(source.side, box);
    const [left, top] = camera.toPage(x0, y1);
    const [right, bottom] = camera.toPage(x1, y0);
    context.strokeRect(left - 4, top - 4, right - left + 8, bottom - top + 8);
  }
  context.setLineDash([]);
}

function drawScaleBar(context, camera, colours) {
  const length = roundBelow(120 / camera.scale);
  const pixels = length * camera.scale;
  const y = camera.height - 14;
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(12, y - 4);
  context.lineTo(12, y);
  context.lineTo(12 + pixels, y);
  context.lineTo(12 + pixels, y - 4);
  context.stroke();
  context.fillText(shortNumber(length), 18 + pixels, y);
}

// path: points in lengths, null where it is unknown; a step of more than half the box crosses a periodic side.
function drawPath(context, camera, { box, axes }, path, colours) {
  context.strokeStyle = colours.accent;
  context.lineWidth = 1.5;
  context.beginPath();
  let last = null;
  for (const point of path) {
    if (point) {
      const far = (axis, k) => axis.periodic && Math.abs(point[k] - last[k]) > [box.width, box.height][k] / 2;
      if (last && !axes.some(far)) context.lineTo(...camera.toPage(...point));
      else context.moveTo(...camera.toPage(...point));
    }
    last = point;
  }
  context.stroke();
}

// frame: its number. picked: as returned by DiskPath.mark, or null.
export function drawOverlay(canvas, density, camera, head, frame, time, picked, colours) {
  const context = canvas.getContext("2d");
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, camera.width, camera.height);
  context.font = "13px system-ui, sans-serif";
  drawObstacles(context, camera, head, colours);
  drawSides(context, camera, head, frame, colours);
  drawScaleBar(context, camera, colours);
  context.textAlign = "right";
  context.fillStyle = colours.ink;
  context.fillText(`t = ${time}`, camera.width - 12, camera.height - 12);
  context.textAlign = "left";
  if (!picked) return;
  drawPath(context, camera, head, picked.path, colours);
  if (!picked.place) return;
  context.strokeStyle = colours.accent;
  context.lineWidth = 3;
  context.beginPath();
  context.arc(...camera.toPage(...picked.place), Math.max(picked.radius * camera.scale, 3) + 3, 0, 2 * Math.PI);
  context.stroke();
}
