// The choice and making of the engine that runs a scene.
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
  int threads = 1;   // number of threads, on each rank
  int ranks = 1;
  RankLead* lead = nullptr;  // of several ranks; outlives what is made
};

// A larger number is a mistake, with which a machine would not answer for minutes.
inline constexpr int most_threads = 4096;

// The engine for --engine and --threads; empty and absent mean the default: parallel, on all cores. The reference
// always has one thread. Throws InputError for an engine that does not exist.
EngineChoice choose_engine(const std::string& engine, std::optional<int> threads, RankLead* lead = nullptr);

// The number of ranks that it leads.
int ranks_of(const RankLead& lead);

// The default number of threads of each of this number of ranks: they share all cores of this machine.
int threads_of_rank(int ranks);

// The initial state of a scene; both engines give the same bits. watch: as in GrowthTools (growth.hpp), called also
// while disks are placed at random; may be empty.
State make_initial_state(const EngineChoice& choice, const Scene& scene,
                         const std::function<void(const GrowthProgress&)>& watch = {});

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial);

// As make_engine, for disks that come in pieces, with several ranks: none has all of them. initial: without disks.
// Precondition: there is a lead.
std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial,
                                    std::unique_ptr<DiskSource> disks);

// As make_engine with make_initial_state; with several ranks each makes its part of the state, if that is possible.
std::unique_ptr<Engine> make_engine_at_start(const EngineChoice& choice, const Scene& scene,
                                             const std::function<void(const GrowthProgress&)>& watch = {});

// The scene and state with which rank 0 made an engine, from which the ranks above 0 make their part.
std::pair<Scene, State> read_rank_start(const std::string& start);

// The engine's threads, for other work between its steps.
BlockRunner make_block_runner(const EngineChoice& choice);

// Throws the InputError of a scene whose disks do not fit into memory.
[[noreturn]] void fail_memory(const Scene& scene);

// Calls make(), which makes the scene's disks or their engine, and reports a lack of memory. A limit on this process
// may be far below the memory of the machine, and the check of the scene does not know it.
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
