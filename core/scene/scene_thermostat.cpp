#include "core/scene/scene_thermostat.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/input_message.hpp"

namespace carom {

Thermostat read_thermostat(const TableReader& physics) {
  Thermostat bath;
  const toml::node* node = physics.find("thermostat");
  if (node == nullptr) return bath;
  constexpr std::string_view expected = "expected { kind = \"langevin\", temperature = T, rate = gamma, dt = ... }";
  const toml::table* table = node->as_table();
  if (table == nullptr) physics.fail("thermostat", fmt::format("is {}", type_name(*node)), expected);
  const TableReader reader(physics.origin(), physics.key("thermostat"), *table);
  for (const std::string_view key : {"kind", "temperature", "rate"}) reader.require(key, expected);
  bath.kind = static_cast<Thermostat::Kind>(reader.choice("kind").value());
  bath.temperature = reader.number("temperature").value();
  bath.rate = reader.number("rate").value();
  bath.dt = reader.number("dt").value_or(0.0);
  return bath;
}

void check_thermostat(const Scene& scene, const PlaceOfKey& place) {
  const Thermostat& bath = scene.physics.thermostat;
  if (!bath.acts()) return;
  const std::string where = place("physics.thermostat");
  if (scene.physics.diffusion > 0.0) {
    fail_input(where, "cannot be used with physics.diffusion: velocities of Brownian disks are drawn anew in each step",
               "expected one of the two");
  }
  const double dt = bath.interval(scene.run.automatic ? 0.0 : scene.run.dt);
  if (dt == 0.0) fail_input(place("physics.thermostat.dt"), "missing", "expected the time between two kicks");
  if (scene.run.method != Method::exact && dt < scene.run.dt) {
    fail_input(place("physics.thermostat.dt"), fmt::format("is {}, below run.dt = {}", dt, scene.run.dt),
               "expected at most one kick in each step");
  }
  if (bath.rate * dt > 1.0) {
    fail_input(place("physics.thermostat.rate"), fmt::format("is {}, so that rate dt is {}", bath.rate, bath.rate * dt),
               "expected rate dt to be at most 1");
  }
}

}  // namespace carom
