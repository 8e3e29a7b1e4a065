// The layout of trajectory.h5: H5MD 1.1 (de Buyl, Colberg, Hoefling 2014), shared by its writer and its reader.
#pragma once

#include <cstdint>
#include <limits>

#include "core/base/types.hpp"

namespace carom {

// /h5md                                 version, author, creator
// /parameters/scene                     the scene with all defaults, as TOML
// /particles/disks/box                  dimension D, boundary; edges [2], or value [frame][3][3] where D is 3, the
//                                       third edge of length 1
// /particles/disks/{position,velocity}  value [frame][place][D], with step and time; D is output.dimensions
// /particles/disks/image                likewise: rounds across the periodic sides, where there are any
// /particles/disks/angular_velocity     value [frame][place], of rough disks
// /particles/disks/id                   value [frame][place]
// /particles/disks/{mass,radius,species} [place]; [frame][place] under value where places change hands (a region)
// /observables/<column of series.csv>   value [frame], with step and time; max_overlap only where series = true; none
//                                       of sides and thermostats
//
// step and time are the same two datasets everywhere. A place without a disk has the id below, and NaN elsewhere.
// species is the disk's group in the scene, counted from 0; disks from sources have the number after the last group's.
inline constexpr DiskId h5md_no_id = 0xffffffffU;
inline constexpr std::uint32_t h5md_no_species = 0xffffffffU;
inline constexpr std::int32_t h5md_no_image = 0;
inline constexpr double h5md_nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr float h5md_single_nothing = std::numeric_limits<float>::quiet_NaN();
inline constexpr const char* h5md_disks = "/particles/disks";

}  // namespace carom
