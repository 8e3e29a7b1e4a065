#include "core/scene/scene_sides.hpp"

#include <fmt/format.h>

#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

constexpr std::string_view table_kind = "box.side";

// A key of a wall's table that another kind of side may not have.
void require_wall(const TableReader& side, std::string_view name, SideKind kind) {
  if (side.find(name) == nullptr || kind == SideKind::wall) return;
  const auto kind_name = side_kind_names[static_cast<std::size_t>(kind)];
  side.fail(name, fmt::format("given of a side of kind \"{}\"", kind_name), "expected kind = \"wall\"");
}

void read_side(const TableReader& side, std::size_t s, Domain& domain) {
  domain.sides[s] = static_cast<SideKind>(side.choice_or_initial("kind"));
  require_wall(side, "restitution", domain.sides[s]);
  require_wall(side, "temperature", domain.sides[s]);
  if (const auto temperature = side.number("temperature")) {
    if (side.find("restitution") != nullptr) {
      side.fail("restitution", "given beside temperature, which draws the velocity anew", "expected one of the two");
    }
    domain.temperatures[s] = *temperature;
    domain.restitutions[s] = 1.0;
  }
  if (const auto restitution = side.number("restitution")) domain.restitutions[s] = *restitution;
}

}  // namespace

void read_sides(const TableReader& box, Domain& domain) {
  domain.restitutions.fill(box.number_or_initial("wall_restitution"));
  for (std::size_t s = 0; s < side_names.size(); ++s) {
    const std::string_view name = side_names[s];
    const toml::node* node = box.find(name);
    if (node != nullptr && node->is_table()) {
      read_side(TableReader(box.origin(), box.key(name), *node->as_table(), table_kind), s, domain);
    } else if (node != nullptr && !node->is_string()) {
      box.fail(name, fmt::format("is {}", type_name(*node)), "expected a string, or a table { kind = ... }");
    } else {
      domain.sides[s] = static_cast<SideKind>(box.choice_or_initial(name));
    }
  }
}

}  // namespace carom
