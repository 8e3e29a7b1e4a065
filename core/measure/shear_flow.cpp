#include "core/measure/shear_flow.hpp"

namespace carom {

Disks relative_to_flow(Disks disks, const Domain& box) {
  if (!box.shear.acts()) return disks;
  for (std::size_t i = 0; i < disks.size(); ++i) disks.vx[i] -= box.shear.flow(disks.y[i], box.height);
  return disks;
}

double shear_stress(double momentum_flow, double shear_virial, double elapsed, const Domain& box) {
  if (!(elapsed > 0.0)) return 0.0;
  return -(momentum_flow + shear_virial / elapsed) / (box.width * box.height);
}

}  // namespace carom
