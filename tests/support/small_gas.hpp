// A scene of a few inelastic disks, for tests of what programs do with a run.
#pragma once

namespace carom::test {

inline constexpr const char* small_gas = R"(seed = 3
[box]
width = 12.0
height = 12.0
[physics]
restitution = 0.9
[[disks]]
count = 20
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.4
mass = 1.0
[run]
method = "exact"
t_end = 1.0
)";

}  // namespace carom::test
