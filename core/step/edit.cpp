#include "core/step/edit.hpp"

#include "core/physics/roughness.hpp"

namespace carom {

namespace {

// inertia: I / (m r^2), 0 for smooth disks.
double energy_of(const Disk& disk, double inertia, const Gravity& gravity) {
  const double kinetic = 0.5 * (disk.vx * disk.vx + disk.vy * disk.vy);
  return disk.mass * (kinetic + gravity.against(disk.x, disk.y)) +
         rotational_energy(inertia, disk.mass, disk.radius, disk.spin);
}

}  // namespace

double energy_brought(const Edit& edit, const Disks& disks, const Gravity& gravity) {
  if (edit.kind == Edit::Kind::add) return energy_of(edit.disk, disks.inertia, gravity);
  const Disk before = disk_at(disks, edit.index);
  if (edit.kind == Edit::Kind::remove) return -energy_of(before, disks.inertia, gravity);
  Disk after = before;
  after.vx = edit.disk.vx;
  after.vy = edit.disk.vy;
  return energy_of(after, disks.inertia, gravity) - energy_of(before, disks.inertia, gravity);
}

void apply(const Edit& edit, State& state) {
  Disks& d = state.disks;
  state.counters.emitted_energy += edit.energy;
  switch (edit.kind) {
    case Edit::Kind::add:
      append(d, edit.disk);
      ++state.next_id;
      return;
    case Edit::Kind::remove: {
      const DiskId id = d.id[edit.index];
      std::erase_if(state.loads, [id](const ContactLoad& load) { return load.id1 == id || load.id2 == id; });
      take_out(d, edit.index);
      return;
    }
    case Edit::Kind::set_velocity:
      d.vx[edit.index] = edit.disk.vx;
      d.vy[edit.index] = edit.disk.vy;
      return;
  }
}

}  // namespace carom
