// Numbers and elements of the page.

// At most five digits, without trailing zeros.
export function shortNumber(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return value.toExponential(3).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(5)));
}

// The largest number of the form 1, 2 or 5 times a power of ten that is at most `value`.
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

export function roundAbove(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const lead of [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) if (lead * power >= value * 0.9999) return lead * power;
  return 10 * power;
}

export const counted = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;

export const element = (id) => document.getElementById(id);

// Text never becomes markup, as names come from the scene.
export function make(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
