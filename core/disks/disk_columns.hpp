// The list of the columns of Disks. All code that copies, moves, adds or removes whole disks goes through it, so that a
// new column cannot be forgotten.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/disks.hpp"

namespace carom {

// Which of the optional columns are present. Kept apart from Disks, because columns of no disks are empty in any case.
struct DiskColumns {
  bool radius = false, mass = false, spin = false;
};

inline DiskColumns columns_of(const Disks& d) {
  return {!d.radius.empty(), !d.mass.empty(), d.spins()};
}

template <class T>
struct DiskColumn {
  std::vector<T> Disks::*entries;
  T Disk::*value;                     // the same quantity of a single disk
  bool DiskColumns::*flag = nullptr;  // null: disks always have it

  constexpr bool is_in(DiskColumns columns) const { return flag == nullptr || columns.*flag; }
};

// Calls use(column) with each DiskColumn; the one of ids comes last.
template <class Use>
constexpr void for_each_column(Use&& use) {
  use(DiskColumn<double>{&Disks::x, &Disk::x});
  use(DiskColumn<double>{&Disks::y, &Disk::y});
  use(DiskColumn<double>{&Disks::vx, &Disk::vx});
  use(DiskColumn<double>{&Disks::vy, &Disk::vy});
  use(DiskColumn<double>{&Disks::radius, &Disk::radius, &DiskColumns::radius});
  use(DiskColumn<double>{&Disks::mass, &Disk::mass, &DiskColumns::mass});
  use(DiskColumn<double>{&Disks::spin, &Disk::spin, &DiskColumns::spin});
  use(DiskColumn<DiskId>{&Disks::id, &Disk::id});
}

constexpr std::size_t count_columns() {
  std::size_t columns = 0;
  for_each_column([&](const auto&) { ++columns; });
  return columns;
}

// Fails if a member of Disks is neither in the list of columns nor one of the three shared numbers (copy_shared).
static_assert(sizeof(Disks) == count_columns() * sizeof(std::vector<double>) + 3 * sizeof(double));

// Calls use(entries) with each column of these disks, empty ones too.
template <class SomeDisks, class Use>
void for_each_column(SomeDisks& d, Use&& use) {
  for_each_column([&](const auto& column) { use(d.*column.entries); });
}

// Calls use(entries of one, entries of the other) with each column.
template <class SomeDisks, class OtherDisks, class Use>
void for_each_column(SomeDisks& one, OtherDisks& other, Use&& use) {
  for_each_column([&](const auto& column) { use(one.*column.entries, other.*column.entries); });
}

// Copies the numbers that all disks share.
inline void copy_shared(const Disks& from, Disks& to) {
  to.common_radius = from.common_radius;
  to.common_mass = from.common_mass;
  to.inertia = from.inertia;
}

// No disks, but the same shared numbers.
inline Disks no_disks_like(const Disks& d) {
  Disks none;
  copy_shared(d, none);
  return none;
}

// Makes a column of the radius, or the mass, if this disk does not share the common one.
inline void make_columns_for(const Disk& disk, DiskColumns& columns, Disks& d) {
  if (!columns.radius && disk.radius != d.common_radius) {
    d.radius.assign(d.size(), d.common_radius);
    columns.radius = true;
  }
  if (!columns.mass && disk.mass != d.common_mass) {
    d.mass.assign(d.size(), d.common_mass);
    columns.mass = true;
  }
}

inline void push_back(Disks& d, const Disk& disk, DiskColumns columns) {
  for_each_column([&](const auto& column) {
    if (column.is_in(columns)) (d.*column.entries).push_back(disk.*column.value);
  });
}

// Overwrites disk i.
inline void put_at(Disks& d, std::size_t i, const Disk& disk) {
  for_each_column([&](const auto& column) {
    auto& entries = d.*column.entries;
    if (!entries.empty()) entries[i] = disk.*column.value;
  });
}

inline void copy_within(Disks& d, std::size_t from, std::size_t to) {
  for_each_column(d, [&](auto& entries) {
    if (!entries.empty()) entries[to] = entries[from];
  });
}

// Keeps the first n disks only.
inline void truncate(Disks& d, std::size_t n) {
  for_each_column(d, [n](auto& entries) {
    if (!entries.empty()) entries.resize(n);
  });
}

// Fills `to` with the disks stored at these places of `from`, in this order. Columns of `to` keep their memory.
template <class Index>
void gather_disks(const Disks& from, const std::vector<Index>& places, Disks& to) {
  copy_shared(from, to);
  for_each_column(from, to, [&](const auto& all, auto& some) {
    some.resize(all.empty() ? 0 : places.size());
    for (std::size_t k = 0; k < some.size(); ++k) some[k] = all[places[k]];
  });
}

// Reserves memory for n disks in all.
inline void reserve(Disks& d, std::size_t n, DiskColumns columns) {
  for_each_column([&](const auto& column) {
    if (column.is_in(columns)) (d.*column.entries).reserve(n);
  });
}

// The same, with a small reserve if memory has to grow: a number of disks that goes up and down a little does not move
// the columns each time, and columns do not double, as they would with push_back.
inline void reserve_amply(Disks& d, std::size_t n, DiskColumns columns) {
  for_each_column([&](const auto& column) {
    auto& entries = d.*column.entries;
    if (column.is_in(columns) && n > entries.capacity()) entries.reserve(n + n / 64);
  });
}

}  // namespace carom
