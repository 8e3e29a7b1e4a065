// Makes the initial disks and obstacles of a scene.
#pragma once

#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/start/growth.hpp"
#include "core/start/placement.hpp"

namespace carom {

// Radii and masses of one group, drawn by (seed, stream, disk id); ids run from first_id. radii and masses get
// group.count entries. Throws InputError if a list is too short.
void draw_sizes(const Scene& scene, const DiskGroup& group, DiskId first_id, std::vector<double>& radii,
                std::vector<double>& masses);

// All groups in file order, ids from 0 on; fixed disks become obstacles and keep their ids. Radius and mass columns
// exist only if disks differ. Throws InputError, with file, line and key, when disks overlap (ids and overlap named),
// lie outside the box, or when "random" or "growth" finds no room for a disk at the density asked for.
State initial_state(const Scene& scene, const PlaceAtRandom& place = place_at_random,
                    const GrowthTools& growth = plain_growth());

// The obstacles alone, as initial_state makes them: fixed disks, then the segments of inner walls. Other disks do not
// grow for it, and are placed only if fixed disks are placed at random.
std::vector<Obstacle> obstacles_of(const Scene& scene);

}  // namespace carom
