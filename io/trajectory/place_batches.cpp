#include "io/trajectory/place_batches.hpp"

#include <algorithm>
#include <utility>

#include "io/trajectory/disk_selection.hpp"

namespace carom {

namespace {

// The least number of places for a call: enough chunks to pack on several threads, some megabytes of disks.
constexpr std::size_t least_batch = std::size_t{1} << 16;

std::size_t place_of(const Selection& select, DiskId id) {
  return (id - select.ids.first) / select.stride;
}

class Batches {
 public:
  Batches(const Selection& select, std::size_t chunk, const std::function<void(const PlaceBatch&)>& use)
      : select_(select), chunk_(chunk), use_(use) {}

  // Adds the next piece.
  void add(const Disks& some) {
    carried_.inertia = some.inertia;
    for (const std::size_t i : by_id(some)) {
      if (!is_selected(select_, some, i)) continue;
      if (!select_.by_region) disk_at_.resize(place_of(select_, some.id[i]) - first_, no_disk);
      disk_at_.push_back(static_cast<std::uint32_t>(carried_.size()));
      append(carried_, carom::disk_at(some, i));
    }
    if (disk_at_.size() >= least_batch) hand_out(disk_at_.size() / chunk_ * chunk_);
  }

  void finish() {
    if (!disk_at_.empty()) hand_out(disk_at_.size());
  }

 private:
  void hand_out(std::size_t count) {
    use_({carried_, disk_at_, first_, count});
    Disks rest;
    rest.inertia = carried_.inertia;
    std::vector<std::uint32_t> places;
    for (std::size_t k = count; k < disk_at_.size(); ++k) {
      const bool empty = disk_at_[k] == no_disk;
      places.push_back(empty ? no_disk : static_cast<std::uint32_t>(rest.size()));
      if (!empty) append(rest, carom::disk_at(carried_, disk_at_[k]));
    }
    carried_ = std::move(rest);
    disk_at_ = std::move(places);
    first_ += count;
  }

  const Selection& select_;
  std::size_t chunk_;
  const std::function<void(const PlaceBatch&)>& use_;
  Disks carried_;
  std::vector<std::uint32_t> disk_at_;  // from place first_ on
  std::size_t first_ = 0;
};

}  // namespace

std::size_t FramePlaces::count() const {
  std::size_t places = 0;
  disks_.visit([&](const Disks& some) {
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!is_selected(select_, some, i)) continue;
      places = select_.by_region ? places + 1 : std::max(places, place_of(select_, some.id[i]) + 1);
    }
  });
  return places;
}

void FramePlaces::visit(const std::function<void(const PlaceBatch&)>& use) {
  Batches batches(select_, chunk_, use);
  disks_.visit([&](const Disks& some) {
    if (some.size() < disks_.size()) return batches.add(some);
    if (disk_at_.empty()) find_places(select_, some, 0, disk_at_);
    if (!disk_at_.empty()) use({some, disk_at_, 0, disk_at_.size()});
  });
  batches.finish();
}

}  // namespace carom
