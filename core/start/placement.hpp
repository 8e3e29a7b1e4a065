// Placing disks at random without overlap: random sequential addition.
#pragma once

#include <functional>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/start/placement_grid.hpp"

namespace carom {

// Places disks one by one (large ones first, equal ones by id): trial k of disk id is a point uniform over the room its
// centre may have, from (seed, Stream::position, id, k), and is taken if it overlaps no disk placed before. members are
// indices into disks, entry i having id i; grid holds the disks already there and gets the new ones. Members
// are all of one group, or of groups without a region.
// Throws InputError (disk, packing fraction reached, remedy) when trials run out: random addition of equal disks jams
// at a packing fraction of 0.547 (Feder 1980), and slows down without bound before.
void place_at_random(const Scene& scene, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> members);

// place_at_random, or what gives the same bits.
using PlaceAtRandom = std::function<void(const Scene&, Disks&, PlacementGrid&, std::vector<std::uint32_t>)>;

// place_at_random, which calls watch after every few disks; what that throws ends it.
PlaceAtRandom place_watched(std::function<void()> watch);

// "file:line: disks.g.key", where messages about group g point; without a line where no line of the file has the group.
std::string place_in_group(const Scene& scene, std::size_t group, std::string_view key);

}  // namespace carom
