// Memory that runs out where a test wants it to: the allocations of a program that includes this, in one of its files.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace carom::test {

inline constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();
inline thread_local std::size_t allocations_left = endless;  // of this thread

// Calls work() with memory for so many allocations of this thread.
template <class Work>
void with_allocations(std::size_t allocations, Work&& work) {
  struct Limit {
    explicit Limit(std::size_t n) { allocations_left = n; }
    ~Limit() { allocations_left = endless; }
    Limit(const Limit&) = delete;
    Limit& operator=(const Limit&) = delete;
  };
  const Limit limit(allocations);
  work();
}

}  // namespace carom::test

// Never inlined: the compiler would take free() for the wrong partner of a `new` that it sees whole. std::stable_sort
// asks for its scratch by the form that does not throw, of which the address sanitizer has one of its own.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  std::size_t& left = carom::test::allocations_left;
  if (left == 0) return nullptr;
  if (left != carom::test::endless) --left;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* const memory = operator new(size, std::nothrow);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
