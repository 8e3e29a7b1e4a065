// Which engine runs a scene.
#pragma once

#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/block_runner.hpp"
#include "core/disks/disk_source.hpp"
#include "core/start/growth.hpp"
#include "core/step/engine.hpp"

namespace carom {

class RankLead;

struct EngineChoice {
  std::string name;  // "reference" or "parallel"
  int threads = 1;   // that it will use, on each rank
  int ranks = 1;
  RankLead* lead = nullptr;  // of several ranks; outlives what is made
};

// More are a slip, with which a machine would not answer for minutes.
inline constexpr int most_threads = 4096;

// What --engine and --threads ask for; empty and absent mean the default: parallel, on all cores. The reference has one
// thread whatever is asked for. Throws InputError for an engine that does not exist.
EngineChoice choose_engine(const std::string& engine, std::optional<int> threads, RankLead* lead = nullptr);

// How many ranks it leads.
int ranks_of(const RankLead& lead);

// Threads of each of so many ranks, where nothing is said: all cores of this machine among them.
int threads_of_rank(int ranks);

// The disks of a scene; either engine's way gives the same bits. watch is that of GrowthTools (growth.hpp), told while
// disks are placed at random, too, and may be empty.
State make_initial_state(const EngineChoice& choice, const Scene& scene,
                         const std::function<void(const GrowthProgress&)>& watch = {});

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial);

// The same of disks that come some at a time, for several ranks: none has all of them. initial: has none.
// Precondition: there is a lead.
std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial,
                                    std::unique_ptr<DiskSource> disks);

// The same of make_initial_state; of several ranks each makes its part of it, where that can be.
std::unique_ptr<Engine> make_engine_at_start(const EngineChoice& choice, const Scene& scene,
                                             const std::function<void(const GrowthProgress&)>& watch = {});

// What the ranks above 0 make a part of: the scene and state with which rank 0 made an engine.
std::pair<Scene, State> read_rank_start(const std::string& start);

// The threads that it chooses, for other work between its steps.
BlockRunner make_block_runner(const EngineChoice& choice);

// Throws the InputError of a scene whose disks do not fit into memory.
[[noreturn]] void fail_memory(const Scene& scene);

// make(), which makes the scene's disks or their engine. A limit on this process may be far below what the machine has,
// and the check of the scene does not see it.
template <class Make>
auto within_memory(const Scene& scene, Make&& make) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    fail_memory(scene);
  } catch (const std::length_error&) {
    fail_memory(scene);
  }
}

}  // namespace carom
