// One scene: every engine, at every number of threads, with frames, interrupted and resumed, has the reference's bits,
// and they make sense.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carom::fuzz {

struct Trial {
  std::string refusal;              // why there is no such scene: the error's line; empty if there is
  std::string account;              // what the run was: method, disks, steps, how it ended
  std::vector<std::string> faults;  // one line each
};

// folder: where relative paths of the scene start.
Trial try_scene(const std::string& text, const std::string& name, const std::string& folder = "");

// The method `exact` against the all-pairs simulation of tests/support/event_oracle.hpp, for as long as chaos lets two
// runs be compared.
Trial try_against_oracle(const std::string& text, const std::string& name);

// On two and on three ranks, step by step: the bits, warnings and errors of one machine.
struct RankTrial : Trial {
  std::size_t on_slabs = 0, alone = 0;  // ranks that had a slab, and those of runs that one rank ran alone
};
RankTrial try_on_ranks(const std::string& text, const std::string& name, const std::string& folder = "");

}  // namespace carom::fuzz
