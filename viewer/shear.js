// A shear flow through periodic sides (Lees and Edwards): the images above the box are displaced along x, and move.

// The displacement of the images above at time t, at most half a width; 0 if the box is not sheared. Computed as
// Shear::offset_at in core/disks/shear.hpp: the remainder of t is exact.
export function offsetAt({ shear, width, height }, t) {
  if (!shear) return 0;
  const jump = shear * height;
  const turn = width / Math.abs(jump);
  const left = t % turn;
  return jump * (Math.abs(left) > turn / 2 ? left - Math.sign(left) * turn : left);
}
