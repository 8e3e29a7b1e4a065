// The interior search kernel, compiled once for every instruction set; CAROM_INTERIOR names the version.

#include <algorithm>

#include "core/physics/disk_pair.hpp"
#include "parallel/stepping/coarse_eight.inl"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/search_kernel.hpp"

namespace carom {

namespace {

// The coarse columns, and the bounds of the test for a level.
template <bool own_radius>
class CoarseTest {
 public:
  // contact2, for equal radii: disks whose squared coarse distance is this or more do not touch.
  CoarseTest(const SearchInput& in, std::uint32_t contact2)
      : position_(in.position), radius_(in.coarse_radius), contact2_(all(contact2)) {}

  void set_disk(std::size_t i) {
    own_position_ = all(position_[i]);
    if constexpr (own_radius) own_reach_ = all(radius_[i] + coarse_radius_error);
  }

  // Which of the disks first .. first + 7 may touch the disk that was set.
  Eight may_touch(std::size_t first) const {
    const Eight distance2 = squared(difference(own_position_, load(position_ + first)));
    if constexpr (own_radius) return exceeds(squared(sum(own_reach_, load(radius_ + first))), distance2);
    return exceeds(contact2_, distance2);
  }

 private:
  const std::uint32_t* position_;
  const std::uint32_t* radius_;
  Eight contact2_;
  Eight own_position_;  // of the disk that was set
  Eight own_reach_;     // unequal radii: its own and the error
};

// Adds the pairs of disk i with those of disks [first, last) that pass the coarse test, and prefetches what the test in
// double precision will read.
template <bool own_radius>
void add_candidates(const SearchInput& in, const CoarseTest<own_radius>& coarse, std::size_t i, std::uint32_t first,
                    std::uint32_t last, std::vector<Pair>& pairs) {
  for (; first < last; first += lanes) {
    for (unsigned near = bits_of(coarse.may_touch(first)); near != 0; near &= near - 1) {
      const std::uint32_t j = first + static_cast<unsigned>(__builtin_ctz(near));
      if (j >= last) break;
      for (const std::size_t k : {i, std::size_t{j}}) {
        __builtin_prefetch(in.x + k);
        __builtin_prefetch(in.y + k);
        if constexpr (own_radius) __builtin_prefetch(in.radius + k);
      }
      pairs.push_back({static_cast<std::uint32_t>(i), j});
    }
  }
}

// Tests disk i against the first disks of both runs. Few disks need it: not inlined, so that the loop over all disks
// keeps its registers.
template <bool own_radius>
[[gnu::noinline]] void test_disk(const SearchInput& in, std::uint32_t contact2, std::uint32_t stride, std::size_t i,
                                 std::vector<Pair>& pairs) {
  CoarseTest<own_radius> coarse(in, contact2);
  coarse.set_disk(i);
  const NearRuns runs = near_runs(in.start, in.key[i], stride, static_cast<std::uint32_t>(i));
  add_candidates(in, coarse, i, runs.own, std::min(runs.own_end, runs.own + lanes), pairs);
  add_candidates(in, coarse, i, runs.above, std::min(runs.above_end, runs.above + lanes), pairs);
}

// Tests those of disks [begin, end) that have a long run (CoarsePositions) against the rest of both runs.
template <bool own_radius>
void test_long_runs(const SearchInput& in, std::uint32_t contact2, std::uint32_t stride, std::size_t begin,
                    std::size_t end, std::vector<Pair>& pairs) {
  CoarseTest<own_radius> coarse(in, contact2);
  auto it = std::lower_bound(in.long_runs.begin(), in.long_runs.end(), begin);
  for (; it != in.long_runs.end() && *it < end; ++it) {
    coarse.set_disk(*it);
    const NearRuns runs = near_runs(in.start, in.key[*it], stride, *it);
    add_candidates(in, coarse, *it, runs.own + lanes, runs.own_end, pairs);
    add_candidates(in, coarse, *it, runs.above + lanes, runs.above_end, pairs);
  }
}

// Removes pairs from index `first` on that do not touch.
template <bool own_radius>
void keep_touching(const SearchInput& in, std::size_t first, std::vector<Pair>& pairs) {
  std::size_t kept = first;
  for (std::size_t k = first; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const double dx = in.x[j] - in.x[i];
    const double dy = in.y[j] - in.y[i];
    const double contact_distance = own_radius ? in.radius[j] + in.radius[i] : in.common_radius + in.common_radius;
    pairs[kept] = pairs[k];
    kept += touches(dx * dx + dy * dy, contact_distance) ? 1U : 0U;
  }
  pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(kept), pairs.end());  // resize could grow, which costs code
}

// A run usually has fewer than eight disks, and usually none of them touches: two disks are tested against eight of
// both runs at once.
template <bool own_radius>
void search_row(const SearchInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                std::vector<Pair>& pairs) {
  const std::uint32_t* const key = in.key;
  const std::uint32_t* const cells_above = in.start + level.stride - 1;
  const std::uint32_t contact2 = coarse_contact2(in.common_radius + in.common_radius, level);
  CoarseTest<own_radius> coarse(in, contact2);
  const auto near_disk = [&](std::size_t i) {
    coarse.set_disk(i);
    return either(coarse.may_touch(i + 1), coarse.may_touch(cells_above[key[i]]));
  };
  const std::size_t found = pairs.size();
  std::size_t i = begin;
  for (; i + 2 <= end; i += 2) {
    if (bits_of(either(near_disk(i), near_disk(i + 1))) == 0) [[likely]]
      continue;
    test_disk<own_radius>(in, contact2, level.stride, i, pairs);
    test_disk<own_radius>(in, contact2, level.stride, i + 1, pairs);
  }
  if (i < end) test_disk<own_radius>(in, contact2, level.stride, i, pairs);
  test_long_runs<own_radius>(in, contact2, level.stride, begin, end, pairs);
  keep_touching<own_radius>(in, found, pairs);
}

}  // namespace

void CAROM_INTERIOR(const SearchInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                    std::vector<Pair>& pairs) {
  if (in.radius == nullptr) {
    search_row<false>(in, level, begin, end, pairs);
  } else {
    search_row<true>(in, level, begin, end, pairs);
  }
}

}  // namespace carom
