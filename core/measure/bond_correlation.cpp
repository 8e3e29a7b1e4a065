#include "core/measure/bond_correlation.hpp"

namespace carom {

BondPairs bond_pairs(const Disks& orders, const Domain& box, const DistanceBins& bins) {
  const DistanceCells cells(orders, box, bins);
  BondPairs found{std::vector<Count>(bins.bins, 0), std::vector<FixedPointSum>(bins.bins)};
  using Place = DistanceCells::Place;
  cells.visit(0, cells.rows(), [&](std::size_t bin, const Place& p, const Place& q) {
    const Vec2 a{orders.vx[p.disk], orders.vy[p.disk]}, b{orders.vx[q.disk], orders.vy[q.disk]};
    const unsigned times = p.centre + q.centre;
    add_term(found.product[bin], times * (a.x * b.x + a.y * b.y));
    found.counts[bin] += times;
  });
  return found;
}

void add_bond_pairs(BondCorrelation& sums, const BondPairs& found) {
  for (std::size_t k = 0; k < found.counts.size(); ++k) {
    sums.product[k] += value_of(found.product[k]);
    sums.pairs[k] += found.counts[k];
  }
  ++sums.samples;
}

}  // namespace carom
