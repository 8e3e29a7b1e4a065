// Asking the system for large pages under arrays that are read at random.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

// v.resize(n), with a word to the system before the memory is touched: with pages of 4 KiB, every random access to
// hundreds of megabytes is a walk through the page table besides. Changes no value; ignored where there is no such
// page.
template <class T>
void resize_in_huge_pages(std::vector<T>& v, std::size_t n, const T& value = T{}) {
  constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21;
  v.reserve(n);
  const auto begin = (reinterpret_cast<std::uintptr_t>(v.data()) + huge_page - 1) / huge_page * huge_page;
  const auto end = (reinterpret_cast<std::uintptr_t>(v.data()) + v.capacity() * sizeof(T)) / huge_page * huge_page;
  if (begin < end) {
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // NOLINT(performance-no-int-to-ptr)
  }
  v.resize(n, value);
}

}  // namespace carom
