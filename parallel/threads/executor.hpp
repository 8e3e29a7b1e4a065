// Runs numbered blocks of work on a fixed number of threads. Only this file and its .cpp know the scheduler (oneTBB).
#pragma once

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/base/block_runner.hpp"

namespace carom {

// Blocks are fixed by the size of the work, never by the number of threads, so what each block computes is the same on
// any number of threads; which thread runs it, and when, must not matter.
class Executor {
 public:
  // threads >= 1. One thread runs everything in the caller, in order. Blocks are made smaller by block_divisor (>= 1):
  // tests cut small scenes into many blocks with it; results do not depend on it.
  explicit Executor(int threads, std::size_t block_divisor = 1);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int threads() const { return threads_; }

  // The block size to use instead of the usual size `block`: divided by block_divisor.
  std::size_t grain(std::size_t block) const { return std::max<std::size_t>(1, block / divisor_); }
  // The block size for n items in all. A few large blocks get equal sizes, and their number is a power of two, so that
  // threads can share them evenly.
  std::size_t block_size(std::size_t n, std::size_t block) const;
  // The number of blocks of that size for n items.
  std::size_t blocks(std::size_t n, std::size_t block) const { return blocks_of(n, block_size(n, block)); }

  // task(b) for b = 0 .. blocks - 1. Allocates nothing of its own.
  template <class Task>
  void run(std::size_t blocks, Task&& task) const {
    run_blocks(blocks, task, Sharing::as_they_come);
  }

  // The same for blocks that take about equal times. If they are few, each thread gets the same blocks in every run, so
  // that its part of a small system stays in its own cache.
  template <class Task>
  void run_alike(std::size_t blocks, Task&& task) const {
    run_blocks(blocks, task, blocks <= most_alike ? Sharing::alike : Sharing::as_they_come);
  }

  // task(b, begin, end) for consecutive ranges of block_size(n, block) items that cover n.
  template <class Task>
  void for_ranges(std::size_t n, std::size_t block, Task&& task) const {
    const std::size_t size = block_size(n, block);
    run_alike(blocks_of(n, size), [&](std::size_t b) { task(b, b * size, std::min(n, (b + 1) * size)); });
  }

  // std::sort's result for a total order without equal items, whatever the number of threads.
  template <class Iterator, class Less>
  void sort(Iterator begin, Iterator end, Less less) const;

 private:
  // With more threads, it is better to give blocks to whichever thread is free first.
  static constexpr std::size_t most_alike = 4;
  static std::size_t blocks_of(std::size_t n, std::size_t size) { return (n + size - 1) / size; }
  using Call = void (*)(void*, std::size_t);
  enum class Sharing : std::uint8_t { as_they_come, alike };
  template <class Task>
  void run_blocks(std::size_t blocks, Task& task, Sharing sharing) const;
  void share_out(std::size_t blocks, Sharing sharing, Call call, void* task) const;
  void enter(Call call, void* task) const;  // calls it once within the arena

  struct Arena;
  int threads_;
  std::size_t divisor_;
  std::unique_ptr<Arena> arena_;
};

template <class Task>
void Executor::run_blocks(std::size_t blocks, Task& task, Sharing sharing) const {
  if (threads_ == 1 || blocks <= 1) {
    for (std::size_t b = 0; b < blocks; ++b) task(b);
    return;
  }
  share_out(
      blocks, sharing, [](void* t, std::size_t b) { (*static_cast<Task*>(t))(b); }, std::addressof(task));
}

#ifdef CAROM_THREAD_SANITIZER
inline constexpr bool under_thread_sanitizer = true;
#else
inline constexpr bool under_thread_sanitizer = false;
#endif
// Items below which sorting in one thread is as fast.
inline constexpr std::ptrdiff_t small_sort = 8192;

template <class Iterator, class Less>
void Executor::sort(Iterator begin, Iterator end, Less less) const {
  // The thread sanitizer cannot follow how TBB parallelises a sort.
  if (under_thread_sanitizer || threads_ == 1 || end - begin < small_sort) {
    std::sort(begin, end, less);
    return;
  }
  auto task = [&] { tbb::parallel_sort(begin, end, less); };
  enter([](void* t, std::size_t) { (*static_cast<decltype(task)*>(t))(); }, &task);
}

// A runner with threads of its own, which live as long as it.
BlockRunner blocks_on_threads(int threads);

}  // namespace carom
