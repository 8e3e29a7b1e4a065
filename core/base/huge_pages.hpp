// Memory pages: huge ones for arrays that are read at random, and a way to give pages back to the system.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

// v.reserve(n) that asks the system for huge pages before the memory is touched: with pages of 4 KiB, every random
// access to hundreds of megabytes also costs a walk through the page table. Changes no value; does nothing where the
// system has no huge pages. room: v reserves so many entries if that is more than n; entries beyond n lie in small
// pages. No page takes memory before it is used.
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

// v.resize(n, value), in huge pages.
template <class T>
void resize_in_huge_pages(std::vector<T>& v, std::size_t n, const T& value = T{}, std::size_t room = 0) {
  reserve_in_huge_pages(v, n, room);
  v.resize(n, value);
}

// v.resize(n). If v allocates, the new memory is in huge pages.
template <class T>
void grow_in_huge_pages(std::vector<T>& v, std::size_t n) {
  if (v.capacity() < n) reserve_in_huge_pages(v, n);
  v.resize(n);
}

// Moves the entries of v to huge pages, if they fill several.
template <class T>
void move_to_huge_pages(std::vector<T>& v) {
  constexpr std::size_t several = std::size_t{1} << 23;
  if (v.size() * sizeof(T) < several) return;
  std::vector<T> moved;
  reserve_in_huge_pages(moved, v.size());
  moved.assign(v.begin(), v.end());
  v.swap(moved);
}

// Gives the whole pages among v[begin] to v[end - 1] back to the system; an entry there is afterwards zero or
// unchanged.
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
