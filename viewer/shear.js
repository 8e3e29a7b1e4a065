// A shear flow through periodic sides (Lees and Edwards): the images above the box are displaced along x, and move.

// Displacement of the images above at time t, at most half a width; 0 where the box is not sheared. As Shear::offset_at
// of core/disks/shear.hpp: what is left of t is exact.
export function offsetAt({ shear, width, height }, t) {
  if (!shear) return 0;
  const jump = shear * height;
  const turn = width / Math.abs(jump);
  const left = t % turn;
  return jump * (Math.abs(left) > turn / 2 ? left - Math.sign(left) * turn : left);
}
