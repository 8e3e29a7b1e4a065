// The panel beside the picture: the legend of the colours, the facts of the picked disk, the link and the picture.
import { colourNames, cssColour, groupColours, palette } from "./colours.js";
import { element, make, shortNumber } from "./format.js";

export function fillChoices(select, entries, chosen) {
  for (const [value, text] of entries) select.append(make("option", text, { value }));
  select.value = chosen;
}

export function colourChoices({ grouped }) {
  return Object.entries(colourNames).filter(([name]) => name !== "group" || grouped);
}

// Shows the scale, or a list of the groups in the table.
export function showLegend(name, range, store) {
  const list = element("groups");
  list.replaceChildren();
  const scaled = name !== "group" && name !== "fixed";
  element("scale").hidden = !scaled;
  if (scaled) {
    const bar = element("bar");
    const bytes = new Uint8ClampedArray(256 * bar.height * 4);
    for (let row = 0; row < bar.height; ++row) bytes.set(palette(name), row * 1024);
    bar.getContext("2d").putImageData(new ImageData(bytes, 256, bar.height), 0, 0);
    element("low").value = Number(range[0].toPrecision(6));
    element("high").value = Number(range[1].toPrecision(6));
  }
  if (name !== "group") return;
  const numbers = [...new Set(store.group)].sort((a, b) => a - b).slice(0, 64);
  for (const number of numbers) {
    const swatch = make("i");
    swatch.style.background = cssColour(groupColours[number % 8]);
    const item = make("li");
    item.append(swatch, store.head.groups[number] || `group ${number}`);
    list.append(item);
  }
}

// facts: pairs of a name and a text.
export function showFacts(facts) {
  const list = element("facts");
  list.replaceChildren(...facts.flatMap(([name, text]) => [make("dt", name), make("dd", text)]));
}

// i: the disk's index in frame k, or -1 if the disk is not in it.
export function factsOf(store, k, place, i) {
  const facts = [
    ["mass", shortNumber(store.mass[place])],
    ["radius", shortNumber(store.radius[place])],
  ];
  if (store.head.grouped) {
    const number = store.group[place];
    facts.push(["group", store.head.groups[number] || String(number)]);
  }
  if (i < 0) return [...facts, ["place", "not in this frame"]];
  const frame = store.frame(k);
  const [ax, ay] = store.head.axes;
  facts.push(["place", `${shortNumber(frame.x[i] * ax.quantum)}, ${shortNumber(frame.y[i] * ay.quantum)}`]);
  const { d, over } = store.steps(k);
  const [vx, vy] = [d[2 * i] / over, d[2 * i + 1] / over];
  facts.push(["velocity", `${shortNumber(vx)}, ${shortNumber(vy)}`], ["speed", shortNumber(Math.hypot(vx, vy))]);
  return facts;
}
