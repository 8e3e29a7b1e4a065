// Pages of memory: large ones under arrays that are read at random, and those given back that are read no more.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

// v.reserve(n), with a word to the system before the memory is touched: with pages of 4 KiB, every random access to
// hundreds of megabytes is a walk through the page table besides. Changes no value; ignored where there is no such
// page. room: for so many, where v allocates; what is beyond n is in small pages. None takes memory until it is used.
template <class T>
void reserve_in_huge_pages(std::vector<T>& v, std::size_t n, std::size_t room = 0) {
  constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21;
  v.reserve(std::max(n, room));
  const auto begin = (reinterpret_cast<std::uintptr_t>(v.data()) + huge_page - 1) / huge_page * huge_page;
  const auto end = (reinterpret_cast<std::uintptr_t>(v.data()) + n * sizeof(T)) / huge_page * huge_page;
  if (begin < end) {
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // NOLINT(performance-no-int-to-ptr)
  }
}

// v.resize(n, value), in such pages.
template <class T>
void resize_in_huge_pages(std::vector<T>& v, std::size_t n, const T& value = T{}, std::size_t room = 0) {
  reserve_in_huge_pages(v, n, room);
  v.resize(n, value);
}

// Gives the memory of v[begin] to v[end - 1] back to the system, as far as it fills pages; what is read there
// afterwards is zero, or as it was.
template <class T>
void give_back_pages(std::vector<T>& v, std::size_t begin, std::size_t end) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(v.data() + begin) + page - 1) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(v.data() + end) / page * page;
  if (first < last) {
    madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);  // NOLINT(performance-no-int-to-ptr)
  }
}

}  // namespace carom
