#include "core/start/placement.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/scene/place_in_file.hpp"
#include "core/start/placement_search.hpp"

namespace carom {

void place_at_random(const Scene& scene, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> members) {
  place_watched([] {})(scene, disks, grid, std::move(members));
}

PlaceAtRandom place_watched(std::function<void()> watch) {
  constexpr std::size_t disks_between_looks = 16;  // the last disks before a jam may take milliseconds each
  return [watch = std::move(watch)](const Scene& scene, Disks& disks, PlacementGrid& grid,
                                    std::vector<std::uint32_t> members) {
    PlacementSearch search = make_placement_search(scene, disks, grid, members);
    while (search.next_class()) {
      for (std::size_t k = search.begin; k < search.end; ++k) {
        if (k % disks_between_looks == 0) watch();
        while (search.lesson_due(k)) search.learn();
        search.place_one(k);
      }
    }
  };
}

std::string place_in_group(const Scene& scene, std::size_t group, std::string_view key) {
  const DiskGroup& g = scene.groups[group];
  if (key == "positions" && !g.positions.where.empty()) return g.positions.where;
  return place_in_file(scene.file, g.line, fmt::format("disks.{}.{}", group, key));
}

}  // namespace carom
