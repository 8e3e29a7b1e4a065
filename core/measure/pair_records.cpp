#include "core/measure/pair_records.hpp"

#include "core/measure/measured_disks.hpp"

namespace carom {

namespace {

void add_counts(PairRecord& pairs, const PairCounts& found) {
  for (std::size_t k = 0; k < pairs.counts.size(); ++k) pairs.counts[k] += found.counts[k];
  pairs.centres += found.centres;
}

void add_pairs(PairRecord& pairs, const PairCounts& found, double area) {
  const auto n = static_cast<double>(found.centres);
  add_counts(pairs, found);
  if (found.centres > 0) pairs.expected += n * (n - 1.0) / area;
}

// Pairs of two different groups: those of the union less those within each.
PairCounts between(const PairCounts& both, const PairCounts& one, const PairCounts& other) {
  PairCounts pairs{both.centres, both.counts};
  for (std::size_t k = 0; k < pairs.counts.size(); ++k) pairs.counts[k] -= one.counts[k] + other.counts[k];
  return pairs;
}

Disks joined(const Disks& all, const IdRange& one, const IdRange& other) {
  Disks both = disks_of(all, one);
  const Disks more = disks_of(all, other);
  for (std::size_t i = 0; i < more.size(); ++i) append(both, disk_at(more, i));
  return both;
}

}  // namespace

DistanceBins distance_bins(const DistancePlan& plan) {
  return {plan.r_max, static_cast<std::size_t>(plan.bins), plan.wall_margin};
}

std::vector<PairCounts> pairs_of_plan(const AnalysisPlan& plan, const Disks& all, const Domain& box,
                                      const BlockRunner& run) {
  const std::vector<NamedIds>& groups = plan.pair_groups;
  const DistanceBins bins = distance_bins(plan.pairs);
  std::vector<PairCounts> found{plan.group.empty() ? count_pairs(all, box, bins, run)
                                                   : count_pairs(disks_of(all, plan.ids), box, bins, run)};
  for (std::size_t k = 0; k < groups.size(); ++k) {
    found.push_back(count_pairs(disks_of(all, groups[k].ids), box, bins, run));
    for (std::size_t l = k + 1; l < groups.size(); ++l) {
      found.push_back(count_pairs(joined(all, groups[k].ids, groups[l].ids), box, bins, run));
    }
  }
  return found;
}

void add_pairs(PairRecord& measured, std::vector<PairRecord>& partial, const AnalysisPlan& plan, const Domain& box,
               const std::vector<PairCounts>& found) {
  const double area = area_of_centres(box, distance_bins(plan.pairs));
  add_pairs(measured, found.front(), area);
  const std::size_t groups = plan.pair_groups.size();
  std::vector<std::size_t> alone;  // indices of the pairs within each group
  for (std::size_t k = 0, next = 1; k < groups; next += groups - k++) alone.push_back(next);
  for (std::size_t k = 0; k < groups; ++k) {
    const PairCounts& one = found[alone[k]];
    add_pairs(partial[alone[k] - 1], one, area);
    for (std::size_t l = k + 1; l < groups; ++l) {
      const PairCounts& other = found[alone[l]];
      const std::size_t both = alone[k] + l - k;
      PairRecord& pairs = partial[both - 1];
      add_counts(pairs, between(found[both], one, other));
      pairs.expected += 2.0 * static_cast<double>(one.centres) * static_cast<double>(other.centres) / area;
    }
  }
}

}  // namespace carom
