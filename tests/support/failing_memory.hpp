// Lets allocations fail at a chosen point. To be included by one file of a test program; it replaces operator new.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace carom::test {

inline constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();
inline thread_local std::size_t allocations_left = endless;  // of this thread

// Calls work(); this thread's allocations after the given number fail.
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

// Never inlined: the compiler would warn that free() does not match a `new` that it inlines. The form that does not
// throw is needed for std::stable_sort, and because the address sanitizer has its own.
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
