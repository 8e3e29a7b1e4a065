#include "core/scene/scene_shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/input_message.hpp"
#include "core/scene/scene_ranges.hpp"

namespace carom {

namespace {

constexpr std::string_view either = "expected one of the two";

void check_shear(const Scene& scene, const PlaceOfKey& place) {
  const std::string where = place("box.shear_rate");
  const auto beside = [&](bool given, std::string_view what) {
    if (given) fail_input(where, fmt::format("cannot be used with {}", what), either);
  };
  if (!scene.box.periodic_x() || !scene.box.periodic_y()) {
    fail_input(where, "cannot be used in a box that is not periodic both ways", "expected all four sides periodic");
  }
  const bool fixed = std::any_of(scene.groups.begin(), scene.groups.end(), [](const DiskGroup& g) { return g.fixed; });
  beside(fixed, "fixed disks");
  beside(!scene.walls.empty(), "[[walls]]");
  beside(!scene.sources.empty(), "[[sources]]");
  beside(scene.physics.gravity.acts(), "physics.gravity");
  beside(scene.physics.diffusion > 0.0, "physics.diffusion: Brownian disks have no velocity");
  beside(scene.physics.collapse_contact_time.has_value(), "physics.collapse");
  if (scene.run.automatic) {
    fail_input(place("run.method"), "is \"auto\", but the errors of methods with box.shear_rate are not known",
               "expected a method by name");
  }
}

}  // namespace

double read_shear_rate(const TableReader& box) {
  const toml::node* node = box.find("shear_rate");
  if (node == nullptr) return 0.0;
  const double rate = as_number(box.origin(), box.key("shear_rate"), *node);
  if (!in_range(Dimension::frequency, std::abs(rate))) {
    box.fail("shear_rate", fmt::format("is {}", rate), expected_range(Dimension::frequency));
  }
  return rate == 0.0 ? 0.0 : rate;
}

void settle_shear(Scene& scene, double largest_radius, const PlaceOfKey& place) {
  Shear& shear = scene.box.shear;
  if (!shear.acts()) return;
  check_shear(scene, place);
  shear.jump = shear.rate * scene.box.height;
  const double speed = std::abs(shear.jump);
  const double crossings = speed * scene.run.t_end / scene.box.width;
  if (!in_range(Dimension::speed, speed) || !(crossings <= most_crossings)) {
    fail_input(place("box.shear_rate"),
               fmt::format("is {}: the images above move at a speed of {}, by {:g} widths until run.t_end = {}",
                           shear.rate, speed, crossings, scene.run.t_end),
               fmt::format("expected at most 2^53 = {:g} widths", most_crossings));
  }
  const double least = 8.0 * largest_radius;
  if (scene.box.width >= least && scene.box.height >= least) return;
  fail_input(place("box.shear_rate"),
             fmt::format("cannot be used in a box of {} x {} with a disk of radius {}", scene.box.width,
                         scene.box.height, largest_radius),
             fmt::format("expected sides of at least {}, four diameters of the largest disk", least));
}

}  // namespace carom
