// The trial of a scene: every engine has the bits of the reference, at every number of threads, with frames,
// interrupted and resumed, and the results are plausible.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom::fuzz {

struct Trial {
  std::string refusal;              // the error if the scene cannot be made; otherwise empty
  std::string account;              // a description of the run: method, disks, steps, how it ended
  std::vector<std::string> faults;  // one line for each fault
};

// folder: to which relative paths in the scene refer.
Trial try_scene(const std::string& text, const std::string& name, const std::string& folder = "");

// Compares the method `exact` with the simulation of tests/support/event_oracle.hpp, which tests all pairs, for as long
// as chaos allows.
Trial try_against_oracle(const std::string& text, const std::string& name);

// On two and on three ranks, step by step: the bits, warnings and errors must be those of a single machine.
struct RankTrial : Trial {
  std::size_t on_slabs = 0,
              alone = 0;  // numbers of ranks that had a slab, and of those in runs that one rank ran alone
};
RankTrial try_on_ranks(const std::string& text, const std::string& name, const std::string& folder = "");

}  // namespace carom::fuzz
