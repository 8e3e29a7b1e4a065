// The names of the values of enums in scene files, in the order of each enum.
#pragma once

#include <array>
#include <string_view>

#include "core/scene/scene.hpp"

namespace carom {

inline constexpr std::array<std::string_view, 4> side_names{"left", "right", "bottom", "top"};  // Side
inline constexpr std::array<std::string_view, 3> side_kind_names{"wall", "periodic", "sink"};   // SideKind
inline constexpr std::array<std::string_view, 2> vibration_shapes{"parabola", "sine"};
inline constexpr std::array<std::string_view, 2> inner_wall_kind_names{"wall", "sink"};          // InnerWall::sink
inline constexpr std::array<std::string_view, 3> method_names{"rollback", "pairwise", "exact"};  // Method
// The values of run.method and --method: a method, or "auto" for the one that run.accuracy needs.
inline constexpr std::array<std::string_view, 4> method_words{"rollback", "pairwise", "exact", "auto"};
inline constexpr std::array<std::string_view, 3> trajectory_names{"none", "xyz", "h5md"};  // TrajectoryFormat
// PositionLaw::Kind
inline constexpr std::array<std::string_view, 4> position_names{"random", "square", "hexagonal", "growth"};
inline constexpr std::array<std::string_view, 2> precision_names{"double", "single"};
inline constexpr std::array<std::string_view, 5> colour_names{"speed", "group", "radius", "mass", "id"};  // ColourBy
inline constexpr std::array<std::string_view, quantities> quantity_names{
    "pair_correlation", "displacement",   "speeds",           "density",
    "pressure",         "collision_rate", "profile",          "velocity_autocorrelation",
    "structure_factor", "bond_order",     "bond_correlation", "bond_autocorrelation"};  // Quantity
inline constexpr std::array<std::string_view, 2> axis_names{"x", "y"};
inline constexpr std::array<std::string_view, 1> collapse_models{"tc"};
inline constexpr std::array<std::string_view, 2> thermostat_names{"langevin", "andersen"};  // Thermostat::Kind
inline constexpr std::array<std::string_view, 2> plot_names{"velocity", "energy"};

constexpr std::string_view name_of(Method method) {
  return method_names[static_cast<std::size_t>(method)];
}

}  // namespace carom
