#include "parallel/slabs/open_places.hpp"

#include "core/start/placement_search.hpp"

namespace carom {

bool OpenPlaces::lesson_due(std::size_t placed) const {
  if (list_) return in_vain_ > list_->patience();
  if (cells_) return cells_->list_due(open_);
  return trials_are_many(trials_, placed);
}

std::size_t OpenPlaces::disks_before_lesson(const std::vector<std::uint64_t>& trials) const {
  if (!list_) return trials.size();
  std::uint64_t sum = in_vain_;
  std::size_t k = 0;
  while (k < trials.size() && sum <= list_->patience()) sum += trials[k++];
  return k;
}

bool OpenPlaces::learn() {
  if (!list_ && !cells_) return make_cells();
  if (list_) {
    list_->replace(list_->survivors(grid_, 0, list_->size()));
  } else {
    make_list();
  }
  share_list();
  return true;
}

bool OpenPlaces::make_cells() {
  cells_.emplace(box_, class_.smallest, class_.disks, nullptr, known_);
  if (cells_->tile_height() > tallest_tile_) return false;
  grid_.for_each([&](std::size_t i) { cells_->close_around(disks_.x[i], disks_.y[i], disks_.radius_of(i)); });
  auto open = static_cast<std::int64_t>(cells_->open());
  ranks_.sum({&open, 1});
  open_ = static_cast<std::size_t>(open);
  closed_ahead_ = false;
  return true;
}

void OpenPlaces::make_list() {
  if (closed_ahead_) make_cells();
  list_.emplace(cells_->list());
  cells_.reset();
}

// The ranks' rows lie one above the other, and so do their parts of the list.
void OpenPlaces::share_list() {
  std::vector<std::int64_t> sizes(static_cast<std::size_t>(ranks_.count()), 0);
  const auto rank = static_cast<std::size_t>(ranks_.rank());
  sizes[rank] = static_cast<std::int64_t>(list_->size());
  ranks_.sum(sizes);
  std::size_t before = 0;
  std::size_t all = 0;
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    if (r == rank) before = all;
    all += static_cast<std::size_t>(sizes[r]);
  }
  list_->be_part(before, all);
  in_vain_ = 0;
}

// For each disk, the number of cells that it closes and that those before it do not.
std::vector<std::int64_t> OpenPlaces::close(const std::vector<DiskToPlace>& disks,
                                            const std::vector<TrialPlace>& places) {
  std::vector<std::int64_t> closed;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t before = cells_->open();
    cells_->close_around(places[k].at.x, places[k].at.y, disks[k].radius);
    closed.push_back(static_cast<std::int64_t>(before - cells_->open()));
  }
  ranks_.sum(closed);
  return closed;
}

std::size_t OpenPlaces::take_in(std::size_t placed, const std::vector<DiskToPlace>& disks,
                                const std::vector<TrialPlace>& places) {
  const std::vector<std::int64_t> closed = cells_ ? close(disks, places) : std::vector<std::int64_t>(places.size(), 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k > 0 && lesson_due(placed + k)) {
      closed_ahead_ = cells_.has_value();
      return k;
    }
    if (trials_ + places[k].trial >= most_trials_) return 0;
    trials_ += places[k].trial;
    in_vain_ += places[k].trial;
    open_ -= static_cast<std::size_t>(closed[k]);
  }
  return places.size();
}

}  // namespace carom
