// Random sequential addition: places disks at random without overlap.
#pragma once

#include <functional>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/start/placement_grid.hpp"

namespace carom {

// Places disks one by one (large ones first, equal ones by id): trial k of disk id is a point uniform over the room of
// its centre, from (seed, Stream::position, id, k), and is accepted if the disk there overlaps none placed before.
// members are indices into disks, entry i having id i; grid holds the disks already placed, and the new ones are added
// to it. Members are all of one group, or of groups without a region. Throws InputError (disk, packing fraction
// reached, remedy) when trials run out: random addition of equal disks jams at a packing fraction of 0.547 (Feder
// 1980), and slows down without bound before.
void place_at_random(const Scene& scene, Disks& disks, PlacementGrid& grid, std::vector<std::uint32_t> members);

// place_at_random, or a function that gives the same bits.
using PlaceAtRandom = std::function<void(const Scene&, Disks&, PlacementGrid&, std::vector<std::uint32_t>)>;

// place_at_random that calls watch after every few disks; an exception thrown by watch ends it.
PlaceAtRandom place_watched(std::function<void()> watch);

// "file:line: disks.g.key" for messages about group g; without a line if the group is in no line of the file.
std::string place_in_group(const Scene& scene, std::size_t group, std::string_view key);

}  // namespace carom
