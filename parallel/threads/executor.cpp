#include "parallel/threads/executor.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <bit>
#include <optional>

#include "core/base/float_environment.hpp"

#ifdef CAROM_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace carom {

namespace {

// The thread sanitizer cannot see that blocks begin after run() was called and end before it returns: Debian's oneTBB
// is built without it, and so is this file (cmake/Sanitizers.cmake). These two relations are therefore announced to it,
// and no others: blocks of one run stay unordered among themselves.
#ifdef CAROM_THREAD_SANITIZER
struct ForkJoin {
  char fork = 0, join = 0;
  void before_all() { __tsan_release(&fork); }
  void begin_block() { __tsan_acquire(&fork); }
  void end_block() { __tsan_release(&join); }
  void after_all() { __tsan_acquire(&join); }
};
#else
struct ForkJoin {
  void before_all() {}
  void begin_block() {}
  void end_block() {}
  void after_all() {}
};
#endif

}  // namespace

// More threads than cores must be possible (determinism is tested that way), hence the limit in addition to the arena.
// The limit holds for the whole process, and the smallest one is effective, so all executors set the same. oneTBB comes
// near it when many executors follow each other on a busy machine: it may start a thread although another is just going
// to sleep, and it ends none.
struct Executor::Arena {
  static constexpr int most_threads = 128;
  explicit Arena(int threads) : arena(threads) {
    if (threads > tbb::info::default_concurrency()) {
      limit.emplace(tbb::global_control::max_allowed_parallelism, std::max(threads, most_threads));
    }
  }
  std::optional<tbb::global_control> limit;
  tbb::task_arena arena;
};

Executor::Executor(int threads, std::size_t block_divisor)
    : threads_(std::max(1, threads)),
      divisor_(std::max<std::size_t>(1, block_divisor)),
      arena_(threads_ > 1 ? std::make_unique<Arena>(threads_) : nullptr) {}

Executor::~Executor() = default;

std::size_t Executor::block_size(std::size_t n, std::size_t block) const {
  constexpr std::size_t least_large = 4096;
  constexpr std::size_t most_few = 8;
  const std::size_t size = grain(block);
  if (size < least_large || n <= size || n > most_few * size) return size;
  const std::size_t shares = std::bit_ceil(blocks_of(n, size));
  return (n + shares - 1) / shares;
}

void Executor::share_out(std::size_t blocks, Sharing sharing, Call call, void* task) const {
  ForkJoin order;
  const auto run_some = [&](const tbb::blocked_range<std::size_t>& some) {
    order.begin_block();
    const FloatEnvironment environment;
    for (std::size_t b = some.begin(); b != some.end(); ++b) call(task, b);
    order.end_block();
  };
  const tbb::blocked_range<std::size_t> all(0, blocks, 1);
  order.before_all();
  arena_->arena.execute([&] {
    if (sharing == Sharing::alike) {
      tbb::parallel_for(all, run_some, tbb::static_partitioner{});
    } else {
      tbb::parallel_for(all, run_some, tbb::auto_partitioner{});
    }
  });
  order.after_all();
}

void Executor::enter(Call call, void* task) const {
  arena_->arena.execute([&] { call(task, 0); });
}

BlockRunner blocks_on_threads(int threads) {
  const auto executor = std::make_shared<const Executor>(threads);
  return
      [executor](std::size_t blocks, const BlockTask& task) { executor->run(blocks, [&](std::size_t b) { task(b); }); };
}

}  // namespace carom
