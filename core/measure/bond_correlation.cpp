#include "core/measure/bond_correlation.hpp"

#include "core/measure/bond_order.hpp"

namespace carom {

void add_bond_correlation(BondCorrelation& sums, const Disks& disks, const Domain& box, const DistanceBins& bins) {
  Disks ordered;  // centres alone, so that the order of the sums is that of ids
  for (const std::size_t i : by_id(disks)) {
    ordered.x.push_back(disks.x[i]);
    ordered.y.push_back(disks.y[i]);
    ordered.id.push_back(disks.id[i]);
  }
  const std::vector<Vec2> order = bond_orders(ordered, box);
  if (order.empty()) return;
  const DistanceCells cells(ordered, box, bins);
  using Place = DistanceCells::Place;
  cells.visit(0, cells.rows(), [&](std::size_t bin, const Place& p, const Place& q) {
    const Vec2 a = order[p.disk], b = order[q.disk];
    const unsigned times = p.centre + q.centre;
    sums.product[bin] += times * (a.x * b.x + a.y * b.y);
    sums.pairs[bin] += times;
  });
  ++sums.samples;
}

}  // namespace carom
