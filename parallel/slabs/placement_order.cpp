#include "parallel/slabs/placement_order.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "parallel/ranks/message.hpp"

namespace carom {

namespace {

// The number of disks that a rank offers beyond its part of those asked for, since shares are not equal.
constexpr std::size_t offered_more = 64;

bool comes_first(const DiskToPlace& a, const DiskToPlace& b) {
  return a.radius != b.radius ? a.radius > b.radius : a.id < b.id;
}

}  // namespace

PlacementOrder::PlacementOrder(const StartDisks& disks, Ranks& ranks)
    : disks_(disks), ranks_(ranks), equal_(disks.sizes().smallest.radius == disks.sizes().largest.radius) {
  if (equal_) return;
  disks.for_share([&](std::size_t g, Count k) {
    share_.push_back({disks.first_id(g) + static_cast<DiskId>(k), disks.size_of(g, k).radius});
  });
  std::sort(share_.begin(), share_.end(), comes_first);
}

SizeClass PlacementOrder::next_class() const {
  if (equal_) {
    const double radius = disks_.sizes().largest.radius;
    return {radius, radius, static_cast<std::size_t>(disks_.disks()) - given_};
  }
  std::array<double, 1> largest{given_here_ < share_.size() ? share_[given_here_].radius : 0.0};
  ranks_.maximum(largest);
  const double half = 0.5 * largest[0];
  const auto from = share_.begin() + static_cast<std::ptrdiff_t>(given_here_);
  const auto end = std::partition_point(from, share_.end(), [half](const DiskToPlace& d) { return d.radius > half; });
  std::array<std::int64_t, 1> count{end - from};
  std::array<double, 1> least{end == from ? -std::numeric_limits<double>::infinity() : -(end - 1)->radius};
  ranks_.sum(count);
  ranks_.maximum(least);
  return {largest[0], -least[0], static_cast<std::size_t>(count[0])};
}

std::vector<DiskToPlace> PlacementOrder::next(const SizeClass& of, std::size_t most) {
  std::vector<DiskToPlace> disks;
  if (equal_) {
    const std::size_t end = std::min(given_ + most, static_cast<std::size_t>(disks_.disks()));
    for (; given_ < end; ++given_) disks.push_back({static_cast<DiskId>(given_), of.largest});
    return disks;
  }
  const std::size_t offer = 2 * most / static_cast<std::size_t>(ranks_.count()) + offered_more;
  const std::size_t end = std::min(given_here_ + offer, share_.size());
  Bytes message;
  put(message, std::uint8_t{end < share_.size()});
  for (std::size_t k = given_here_; k < end; ++k) put(message, share_[k]);
  // Only disks that come before the last one offered by each rank that has more.
  DiskToPlace last{std::numeric_limits<DiskId>::max(), 0.0};
  for (const Bytes& offered : ranks_.gather(message)) {
    MessageReader reader(offered);
    const bool has_more = reader.get<std::uint8_t>() != 0;
    while (!reader.at_end()) disks.push_back(reader.get<DiskToPlace>());
    if (has_more && comes_first(disks.back(), last)) last = disks.back();
  }
  std::sort(disks.begin(), disks.end(), comes_first);
  const double half = 0.5 * of.largest;
  const auto stop = std::partition_point(
      disks.begin(), disks.end(), [&](const DiskToPlace& d) { return !comes_first(last, d) && d.radius > half; });
  disks.resize(std::min(most, static_cast<std::size_t>(stop - disks.begin())));
  const auto given = std::partition_point(share_.begin(), share_.end(), [&](const DiskToPlace& d) {
    return !disks.empty() && !comes_first(disks.back(), d);
  });
  if (!disks.empty()) given_here_ = static_cast<std::size_t>(given - share_.begin());
  return disks;
}

}  // namespace carom
