// Asking the system for large pages under arrays that are read at random.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

// v.resize(n), with a word to the system before the memory is touched: with pages of 4 KiB, every random access to
// hundreds of megabytes is a walk through the page table besides. Changes no value; ignored where there is no such
// page. room: for so many, where v allocates; what is beyond n is in small pages, and takes no memory until it is used.
template <class T>
void resize_in_huge_pages(std::vector<T>& v, std::size_t n, const T& value = T{}, std::size_t room = 0) {
  constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21;
  v.reserve(std::max(n, room));
  const auto begin = (reinterpret_cast<std::uintptr_t>(v.data()) + huge_page - 1) / huge_page * huge_page;
  const auto end = (reinterpret_cast<std::uintptr_t>(v.data()) + n * sizeof(T)) / huge_page * huge_page;
  if (begin < end) {
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // NOLINT(performance-no-int-to-ptr)
  }
  v.resize(n, value);
}

}  // namespace carom
