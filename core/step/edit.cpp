#include "core/step/edit.hpp"

namespace carom {

namespace {

// The last entry takes the place of entry i.
void take_out(Disks& d, std::size_t i) {
  const auto close = [i](auto& column) {
    if (column.empty()) return;
    column[i] = column.back();
    column.pop_back();
  };
  close(d.x);
  close(d.y);
  close(d.vx);
  close(d.vy);
  close(d.id);
  close(d.radius);
  close(d.mass);
  close(d.spin);
}

}  // namespace

void apply(const Edit& edit, State& state) {
  Disks& d = state.disks;
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
