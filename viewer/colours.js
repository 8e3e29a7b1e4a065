// The quantity that colours stand for, and the colours of its values.
import { roundAbove } from "./format.js";

export const colourNames = {
  speed: "speed",
  group: "group",
  radius: "radius",
  mass: "mass",
  id: "id",
  coordination: "coordination number",
  fixed: "one colour",
};

// Viridis (Smith, van der Walt 2015), every sixteenth of its colours.
const viridis = [
  0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779,
  0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725,
];
// Okabe and Ito: these colours can be told apart with all common kinds of colour blindness. They are those of movies
// (io/movie/colour_scale.cpp).
export const groupColours = [0x0072b2, 0xe69f00, 0x009e73, 0xd55e00, 0xcc79a7, 0x56b4e9, 0xf0e442, 0x999999];

export const parts = (colour) => [colour >> 16, (colour >> 8) & 255, colour & 255];
export const cssColour = (colour) => `#${colour.toString(16).padStart(6, "0")}`;

// 256 colours with four bytes each.
export function palette(name) {
  const bytes = new Uint8Array(1024);
  for (let i = 0; i < 256; ++i) {
    let rgb;
    if (name === "group") rgb = parts(groupColours[(i >> 5) % 8]);
    else if (name === "fixed") rgb = parts(groupColours[0]);
    else {
      const at = (i / 255) * (viridis.length - 1);
      const low = Math.min(viridis.length - 2, Math.floor(at));
      const a = parts(viridis[low]);
      const b = parts(viridis[low + 1]);
      rgb = a.map((value, k) => value + (b[k] - value) * (at - low));
    }
    bytes.set([...rgb.map(Math.round), 255], 4 * i);
  }
  return bytes;
}

// The values by place if they are the same in all frames; otherwise null.
export function fixedValues(name, store) {
  if (name === "radius") return store.radius;
  if (name === "mass") return store.mass;
  if (name === "id") return store.id;
  if (name === "group") return store.group.map((g) => g % 8);
  if (name === "fixed") return new Float32Array(store.head.disks);
  return null;
}

// The ends of the scale that the run asks for.
export function rangeOf(name, store) {
  if (name === "group" || name === "fixed") return [0, 8];
  if (name === "coordination") return [0, 6];
  if (name === "speed") return [0, roundAbove(store.head.fast)];
  const values = fixedValues(name, store);
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low < high ? [low, high] : [Math.min(0, low || 0), Number.isFinite(high) && high > 0 ? high : 1];
}
