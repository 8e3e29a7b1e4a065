// The values of a disk that the sweeps over a step's contacts change, by storage index. Ranks exchange only these
// values.
#pragma once

#include <cstddef>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"

namespace carom {

// Changed by the sweeps over supports.
struct Velocities {
  using Value = Vec2;
  Vec2* v;

  Value get(std::size_t i) const { return v[i]; }
  void set(std::size_t i, const Value& value) const { v[i] = value; }
};

// Changed when disks are pushed apart.
struct Places {
  using Value = Vec2;
  Disks& d;

  Value get(std::size_t i) const { return {d.x[i], d.y[i]}; }
  void set(std::size_t i, const Value& value) const {
    d.x[i] = value.x;
    d.y[i] = value.y;
  }
};

// Changed by impacts.
struct Motions {
  struct Value {
    Vec2 place, velocity;
    double spin;
  };
  Disks& d;

  Value get(std::size_t i) const { return {{d.x[i], d.y[i]}, {d.vx[i], d.vy[i]}, d.spin.empty() ? 0.0 : d.spin[i]}; }
  void set(std::size_t i, const Value& value) const {
    d.x[i] = value.place.x;
    d.y[i] = value.place.y;
    d.vx[i] = value.velocity.x;
    d.vy[i] = value.velocity.y;
    if (!d.spin.empty()) d.spin[i] = value.spin;
  }
};

}  // namespace carom
