#include "core/measure/bond_correlation.hpp"

namespace carom {

namespace {

BondPairs no_pairs(const DistanceBins& bins) {
  return {std::vector<Count>(bins.bins, 0), std::vector<FixedPointSum>(bins.bins)};
}

// Of those in rows [begin, end) of cells.
void add_pairs(const DistanceCells& cells, const DistanceCells::Span& rows, const Disks& orders, BondPairs& pairs) {
  using Place = DistanceCells::Place;
  cells.visit(rows.begin, rows.end, [&](std::size_t bin, const Place& p, const Place& q) {
    const Vec2 a{orders.vx[p.disk], orders.vy[p.disk]}, b{orders.vx[q.disk], orders.vy[q.disk]};
    const unsigned times = p.centre + q.centre;
    add_term(pairs.product[bin], times * (a.x * b.x + a.y * b.y));
    pairs.counts[bin] += times;
  });
}

}  // namespace

BondPairs bond_pairs(const Disks& orders, const Domain& box, const DistanceBins& bins, const BlockRunner& run) {
  const DistanceCells cells(orders, box, bins);
  std::vector<BondPairs> parts(cells.blocks());
  run(parts.size(), [&](std::size_t b) {
    parts[b] = no_pairs(bins);
    add_pairs(cells, cells.rows_of(b), orders, parts[b]);
  });
  BondPairs found = no_pairs(bins);
  for (const BondPairs& part : parts) {
    for (std::size_t k = 0; k < bins.bins; ++k) {
      found.counts[k] += part.counts[k];
      found.product[k] += part.product[k];
    }
  }
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
