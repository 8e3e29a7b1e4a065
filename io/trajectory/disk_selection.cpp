#include "io/trajectory/disk_selection.hpp"

#include <algorithm>

namespace carom {

void find_places(const Selection& select, const Disks& disks, std::size_t least, std::vector<std::uint32_t>& places) {
  places.clear();
  if (select.by_region) {
    for (std::size_t i = 0; i < disks.size(); ++i) {
      if (is_selected(select, disks, i)) places.push_back(static_cast<std::uint32_t>(i));
    }
    std::sort(places.begin(), places.end(), [&](auto a, auto b) { return disks.id[a] < disks.id[b]; });
    places.resize(std::max(places.size(), least), no_disk);
    return;
  }
  places.resize(least, no_disk);
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (!is_selected(select, disks, i)) continue;
    const std::size_t place = (disks.id[i] - select.ids.first) / select.stride;
    if (place >= places.size()) places.resize(std::max(place + 1, places.size() + places.size() / 2), no_disk);
    places[place] = static_cast<std::uint32_t>(i);
  }
  while (places.size() > least && places.back() == no_disk) places.pop_back();
}

}  // namespace carom
