#include "core/reference/remove_taken.hpp"

namespace carom {

void remove_taken(State& state, const std::vector<SinkNumber>& by) {
  std::vector<unsigned char> gone(by.size(), 0);
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (by[i] == no_sink) continue;
    gone[i] = 1;
    count_taken(state.taken, by[i]);
  }
  state.counters.removed += remove_marked(state.disks, gone);
}

}  // namespace carom
