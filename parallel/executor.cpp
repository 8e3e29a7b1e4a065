#include "parallel/executor.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace carom {

// Asking for more threads than cores must be possible (determinism is tested so), hence the global limit beside the
// arena.
struct Executor::Arena {
  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control limit;
  tbb::task_arena arena;
};

Executor::Executor(int threads, std::size_t block_divisor)
    : threads_(std::max(1, threads)),
      divisor_(std::max<std::size_t>(1, block_divisor)),
      arena_(threads_ > 1 ? std::make_unique<Arena>(threads_) : nullptr) {}

Executor::~Executor() = default;

void Executor::run_blocks(std::size_t blocks, Call call, void* task) const {
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, blocks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t b = range.begin(); b != range.end(); ++b) call(task, b);
        },
        tbb::auto_partitioner{});
  });
}

void Executor::enter(Call call, void* task) const {
  arena_->arena.execute([&] { call(task, 0); });
}

}  // namespace carom
