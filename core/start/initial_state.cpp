#include "core/start/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/place_in_file.hpp"
#include "core/scene/size_law.hpp"
#include "core/start/between_sides.hpp"
#include "core/start/initial_velocities.hpp"
#include "core/start/lattice_places.hpp"
#include "core/start/placement.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/wall_segments.hpp"

namespace carom {

namespace {

// Replaces a column by one number if all entries are equal.
void share_where_equal(std::vector<double>& column, double& common) {
  common = 0.0;
  if (std::adjacent_find(column.begin(), column.end(), std::not_equal_to<>()) != column.end()) return;
  common = column.front();
  column = {};
}

// Sets one radius and mass for all disks if the laws give one; columns otherwise.
void set_sizes(const Scene& scene, Disks& disks, std::size_t n) {
  const auto size_of_first = [&](const DiskGroup& g) {
    return draw_size(g.radius, g.mass, scene.seed, Stream::radius, Stream::mass, 0, 0);
  };
  bool equal = true;
  for (const DiskGroup& g : scene.groups) {
    if (g.count == 0) continue;
    equal = equal && same_for_all(g.radius, g.mass);
    if (!equal) break;
    const DiskSize size = size_of_first(g);
    const bool first = disks.common_radius == 0.0;
    equal = first || (size.radius == disks.common_radius && size.mass == disks.common_mass);
    disks.common_radius = size.radius;
    disks.common_mass = size.mass;
  }
  if (equal) return;
  disks.radius.reserve(n);
  disks.mass.reserve(n);
  DiskId first_id = 0;
  for (const DiskGroup& g : scene.groups) {
    std::vector<double> radii;
    std::vector<double> masses;
    draw_sizes(scene, g, first_id, radii, masses);
    disks.radius.insert(disks.radius.end(), radii.begin(), radii.end());
    disks.mass.insert(disks.mass.end(), masses.begin(), masses.end());
    first_id += static_cast<DiskId>(g.count);
  }
  share_where_equal(disks.radius, disks.common_radius);
  share_where_equal(disks.mass, disks.common_mass);
}

// A scene that starts without disks takes the size of its first source as common radius and mass, if that has one size:
// then emitted disks need no columns.
void set_sizes_of_source(const Scene& scene, Disks& disks) {
  if (scene.sources.empty()) return;
  const Source& source = scene.sources[0];
  if (!same_for_all(source.radius, source.mass)) return;
  const DiskSize size =
      draw_size(source.radius, source.mass, scene.seed, Stream::source_radius, Stream::source_mass, 0, 0);
  disks.common_radius = size.radius;
  disks.common_mass = size.mass;
}

// A coordinate that the scene gives, checked against the two sides of its axis. The upper end of a periodic axis
// becomes the lower one.
double checked_coordinate(double c, double length, bool periodic, double radius, bool& inside) {
  if (periodic) {
    inside = inside && c >= 0.0 && c <= length;
    return c == length ? 0.0 : c;
  }
  const double slack = place_slack(radius, length);
  inside = inside && c >= radius - slack && c <= length - radius + slack;
  return c;
}

// The name, in messages, of the box or of the room between moving sides at time 0.
std::string room_text(const Domain& box) {
  if (!box.has_moving_side()) return fmt::format("inside the box of {} x {}", box.width, box.height);
  return fmt::format("between the sides at time 0, which are at x = {:g} and {:g}, y = {:g} and {:g}",
                     box.place(Side::left).inset, box.width - box.place(Side::right).inset,
                     box.place(Side::bottom).inset, box.height - box.place(Side::top).inset);
}

// told: the scene as the user wrote it; `scene` is the one between moving sides, at rest.
void place_listed(const Scene& scene, const Scene& told, std::size_t group, DiskId first_id, Disks& disks) {
  const PositionLaw& law = scene.groups[group].positions;
  const Domain& box = scene.box;
  for (std::size_t k = 0; k < law.list.size(); ++k) {
    const std::size_t i = first_id + k;
    const double radius = disks.radius_of(i);
    bool inside = true;
    // A fixed disk may reach out of the box.
    const double room = scene.groups[group].fixed ? 0.0 : radius;
    disks.x[i] = checked_coordinate(law.list[k].x, box.width, box.periodic_x(), room, inside);
    disks.y[i] = checked_coordinate(law.list[k].y, box.height, box.periodic_y(), room, inside);
    if (inside) continue;
    const Vec2 given = told.groups[group].positions.list[k];
    const std::string from = law.file.empty() ? "" : fmt::format(" (row {} of {})", k + 1, law.file);
    fail_input(place_in_group(scene, group, "positions"),
               fmt::format("disk {}{} of radius {} at ({}, {}) is not {}", i, from, radius, given.x, given.y,
                           room_text(told.box)),
               scene.groups[group].fixed
                   ? "expected its centre in the box"
                   : "expected its centre a radius or more from each wall or sink, and within periodic sides");
  }
}

void place_on_lattice(const Scene& scene, std::size_t group, DiskId first_id, Disks& disks) {
  const Count count = scene.groups[group].count;
  if (count == 0) return;
  double radius = 0.0;
  for (std::size_t k = 0; k < count; ++k) radius = std::max(radius, disks.radius_of(first_id + k));
  const LatticePlaces places(scene, group, radius);
  for (Count k = 0; k < count; ++k) {
    const Vec2 place = places.at(k);
    disks.x[first_id + k] = place.x;
    disks.y[first_id + k] = place.y;
  }
}

[[noreturn]] void fail_overlap(const Scene& scene, const Disks& disks, std::size_t i, std::size_t j) {
  const double distance2 = nearest_distance2({disks.x[j] - disks.x[i], disks.y[j] - disks.y[i]}, scene.box);
  const double contact = disks.radius_of(i) + disks.radius_of(j);
  const double overlap = contact - std::sqrt(distance2);
  const std::size_t later = std::max(i, j);
  const std::size_t group = group_of(scene, static_cast<DiskId>(later));
  const bool radii_of_frame = !scene.groups[group].radius.file.empty();
  fail_input(place_in_group(scene, group, "positions"),
             fmt::format("disks {} and {} overlap by {:.6g} ({:.3g} % of r1 + r2)", std::min(i, j), later, overlap,
                         100.0 * overlap / contact),
             radii_of_frame
                 ? "expected centres r1 + r2 or more apart; \"scale\" beside the frame of the radii makes room"
                 : "expected centres r1 + r2 or more apart");
}

// Inserts disks with given places into the grid, large ones first, and checks them against each other. Obstacles are
// inserted before and are not checked: they may overlap each other.
void insert_placed(const Scene& scene, const Disks& disks, std::vector<std::uint32_t> members, PlacementGrid& grid) {
  if (!disks.radius.empty()) {
    std::stable_sort(members.begin(), members.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return disks.radius[a] > disks.radius[b]; });
  }
  for (const std::uint32_t i : members) {
    const std::optional<std::size_t> j = grid.overlapping(disks.x[i], disks.y[i], disks.radius_of(i), true);
    if (j) fail_overlap(scene, disks, i, *j);
    grid.insert(i);
  }
}

void check_clear_of_walls(const Scene& scene, const Domain& box, const Disks& disks, std::uint32_t i) {
  if (box.obstacles == nullptr) return;
  const double r = disks.radius_of(i);
  for_each_solid_touched(box, disks.x[i], disks.y[i], r, [&](std::uint32_t k, const ObstacleGap& gap) {
    if (!(gap.beyond > place_slack(box, r))) return;
    fail_input(place_in_group(scene, group_of(scene, i), "positions"),
               fmt::format("disk {} overlaps the {} by {:.6g}", i, name_of((*box.obstacles)[k]), gap.beyond),
               "expected disks clear of walls");
  });
}

// Places all groups. Random groups with a region come first, each by itself, since the others can be placed anywhere.
// If disks grow, only fixed disks are placed here. told: as in place_listed.
void set_positions(const Scene& scene, const Scene& told, Disks& disks, const PlaceAtRandom& place) {
  std::vector<std::uint32_t> obstacles;
  std::vector<std::uint32_t> placed;
  std::vector<std::uint32_t> anywhere;
  std::vector<std::vector<std::uint32_t>> in_regions;
  DiskId first_id = 0;
  for (std::size_t group = 0; group < scene.groups.size(); ++group) {
    const DiskGroup& g = scene.groups[group];
    if (g.positions.kind == PositionLaw::Kind::growth) {
      first_id += static_cast<DiskId>(g.count);
      continue;
    }
    const bool at_random = g.positions.kind == PositionLaw::Kind::random;
    if (g.positions.kind == PositionLaw::Kind::list) place_listed(scene, told, group, first_id, disks);
    if (!at_random && g.positions.kind != PositionLaw::Kind::list) place_on_lattice(scene, group, first_id, disks);
    const bool regional = at_random && g.positions.region;
    if (regional) in_regions.emplace_back();
    std::vector<std::uint32_t>& members = regional    ? in_regions.back()
                                          : at_random ? anywhere
                                          : g.fixed   ? obstacles
                                                      : placed;
    const std::size_t before = members.size();
    members.resize(before + g.count);
    std::iota(members.begin() + static_cast<std::ptrdiff_t>(before), members.end(), first_id);
    first_id += static_cast<DiskId>(g.count);
  }
  Domain box = scene.box;
  const std::unique_ptr<const ObstacleCells> walls = place_obstacles(segments_of(scene), box);
  for (const std::uint32_t i : placed) check_clear_of_walls(scene, box, disks, i);
  PlacementGrid grid(box, disks);
  for (const std::uint32_t i : obstacles) grid.insert(i);
  insert_placed(scene, disks, std::move(placed), grid);
  for (std::vector<std::uint32_t>& members : in_regions) place(scene, disks, grid, std::move(members));
  place(scene, disks, grid, std::move(anywhere));
}

// The fixed disks, which have their places, followed by the inner walls.
std::vector<Obstacle> standing_obstacles(const Scene& scene, const Disks& disks) {
  std::vector<Obstacle> obstacles;
  std::size_t i = 0;
  for (const DiskGroup& g : scene.groups) {
    for (Count k = 0; k < g.count; ++k, ++i) {
      if (!g.fixed) continue;
      obstacles.push_back({disks.x[i], disks.y[i], 0.0, 0.0, disks.radius_of(i), scene.physics.restitution, disks.id[i],
                           ObstacleKind::disk});
    }
  }
  const std::vector<Obstacle> segments = segments_of(scene);
  obstacles.insert(obstacles.end(), segments.begin(), segments.end());
  return obstacles;
}

// Removes the disks that are obstacles from state.disks; the others keep their ids.
void take_obstacles(const Scene& scene, State& state) {
  Disks& disks = state.disks;
  std::vector<unsigned char> fixed(disks.size(), 0);
  for (const Obstacle& o : state.obstacles) {
    if (!o.is_segment()) fixed[o.id] = 1;
  }
  if (std::find(fixed.begin(), fixed.end(), 1) == fixed.end()) return;
  remove_marked(disks, fixed);
  if (!disks.radius.empty()) share_where_equal(disks.radius, disks.common_radius);
  if (!disks.mass.empty()) share_where_equal(disks.mass, disks.common_mass);
  if (disks.empty()) set_sizes_of_source(scene, disks);
}

// initial_state of a scene whose sides and images are at rest. told: as in place_listed.
State start_at_rest(const Scene& scene, const Scene& told, const PlaceAtRandom& place, const GrowthTools& growth) {
  State state;
  Count total = 0;
  for (const DiskGroup& g : scene.groups) total += g.count;
  const auto n = static_cast<std::size_t>(total);
  Disks& disks = state.disks;
  set_sizes(scene, disks, n);
  if (n == 0) set_sizes_of_source(scene, disks);
  disks.x.resize(n);
  disks.y.resize(n);
  const bool all_grow = std::all_of(scene.groups.begin(), scene.groups.end(),
                                    [](const DiskGroup& g) { return g.positions.kind == PositionLaw::Kind::growth; });
  if (n > 0 && !all_grow) set_positions(scene, told, disks, place);
  disks.id.resize(n);  // only now, since placing needs the most memory
  std::iota(disks.id.begin(), disks.id.end(), DiskId{0});
  state.obstacles = standing_obstacles(scene, disks);
  if (n > 0 && grows(scene)) place_by_growth(scene, disks, state.obstacles, place, growth);
  set_velocities(scene, disks);
  set_spins(scene, disks);
  take_obstacles(scene, state);
  state.next_id = static_cast<DiskId>(n);
  state.sources.resize(scene.sources.size());
  state.taken.resize(sink_numbers(scene));
  return state;
}

}  // namespace

void draw_sizes(const Scene& scene, const DiskGroup& group, DiskId first_id, std::vector<double>& radii,
                std::vector<double>& masses) {
  const auto check = [&](const SizeLaw& law, std::string_view key) {
    if (law.kind != SizeLaw::Kind::list || law.values.size() >= group.count) return;
    fail_input(place_in_file(scene.file, group.line, fmt::format("disks {}", key)),
               fmt::format("has {} for count = {}", counted(law.values.size(), "entry"), group.count),
               "expected one entry for each disk");
  };
  check(group.radius, "radius");
  check(group.mass, "mass");
  radii.resize(group.count);
  masses.resize(group.count);
  for (std::size_t k = 0; k < group.count; ++k) {
    const DiskSize size = draw_size(group.radius, group.mass, scene.seed, Stream::radius, Stream::mass,
                                    first_id + static_cast<DiskId>(k), k);
    radii[k] = size.radius;
    masses[k] = size.mass;
  }
}

State initial_state(const Scene& scene, const PlaceAtRandom& place, const GrowthTools& growth) {
  if (scene.box.has_moving_side()) {
    return moved_back(scene, start_at_rest(inside_moving_sides(scene), scene, place, growth));
  }
  if (!scene.box.shear.acts()) return start_at_rest(scene, scene, place, growth);
  Scene at_rest = scene;  // without shear too: images are not displaced at time 0
  at_rest.box.shear = {};
  State state = start_at_rest(at_rest, scene, place, growth);
  Disks& d = state.disks;
  for (std::size_t i = 0; i < d.size(); ++i) d.vx[i] += scene.box.shear.flow(d.y[i], scene.box.height);
  return state;
}

std::vector<Obstacle> obstacles_of(const Scene& scene) {
  const auto any_fixed = [&](auto&& is_it) {
    return std::any_of(scene.groups.begin(), scene.groups.end(),
                       [&](const DiskGroup& g) { return g.fixed && is_it(g.positions); });
  };
  if (!any_fixed([](const PositionLaw&) { return true; })) return segments_of(scene);
  // Fixed disks of a list or a lattice do not depend on other disks; and before a growth all fixed disks are placed
  // first.
  const bool drawn = any_fixed([](const PositionLaw& law) { return law.kind == PositionLaw::Kind::random; });
  const auto nowhere = [](const Scene&, Disks&, PlacementGrid&, const std::vector<std::uint32_t>&) {};
  GrowthTools none = plain_growth();
  none.step = [](Disks&, const Domain&, const std::vector<double>&) {
    return GrowthTally{};
  };  // reports that all disks have grown
  return initial_state(scene, drawn ? PlaceAtRandom(place_at_random) : PlaceAtRandom(nowhere), none).obstacles;
}

}  // namespace carom
