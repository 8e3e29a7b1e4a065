#include "core/measure/bond_correlation.hpp"

#include <cstdint>

namespace carom {

namespace {

BondPairs no_pairs(const DistanceBins& bins) {
  return {std::vector<Count>(bins.bins, 0), std::vector<FixedPointSum>(bins.bins)};
}

// psi6 by place (DistanceCells), so that a run of places is contiguous in memory.
std::vector<Vec2> orders_by_place(const DistanceCells& cells, const Disks& orders) {
  std::vector<Vec2> psi(orders.size());
  for (std::size_t k = 0; k < psi.size(); ++k) {
    const std::uint32_t disk = cells.disks()[k];
    psi[k] = {orders.vx[disk], orders.vy[disk]};
  }
  return psi;
}

// The pairs of rows [begin, end) of cells. The two members of each sum are kept in separate columns for now: next to
// each other they would be added in a vector register, which takes longer to fill.
BondPairs pairs_in(const DistanceCells& cells, const DistanceCells::Span& rows, const std::vector<Vec2>& psi,
                   const DistanceBins& bins) {
  BondPairs pairs = no_pairs(bins);
  std::vector<std::int64_t> high(bins.bins, 0), low(bins.bins, 0);
  const auto add = [psi_at = psi.data(), centre = cells.are_centres().data(), high_at = high.data(),
                    low_at = low.data(), count = pairs.counts.data()](std::size_t bin, std::size_t p, std::size_t q) {
    const Vec2 a = psi_at[p], b = psi_at[q];
    const int times = centre[p] + centre[q];
    const FixedPointSum term = fixed_point(times * (a.x * b.x + a.y * b.y));
    high_at[bin] += term.high;
    low_at[bin] += term.low;
    count[bin] += static_cast<Count>(times);
  };
  cells.visit(rows.begin, rows.end, add);
  for (std::size_t k = 0; k < bins.bins; ++k) pairs.product[k] = {high[k], low[k]};
  return pairs;
}

}  // namespace

BondPairs bond_pairs(const Disks& orders, const Domain& box, const DistanceBins& bins, const BlockRunner& run) {
  const DistanceCells cells(orders, box, bins);
  const std::vector<Vec2> psi = orders_by_place(cells, orders);
  std::vector<BondPairs> parts(cells.blocks());
  run(parts.size(), [&](std::size_t b) { parts[b] = pairs_in(cells, cells.rows_of(b), psi, bins); });
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
