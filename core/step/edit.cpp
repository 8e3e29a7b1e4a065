#include "core/step/edit.hpp"

namespace carom {

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
