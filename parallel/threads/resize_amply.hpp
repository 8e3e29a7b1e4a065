// Resizes lists whose length grows slowly from step to step.
#pragma once

#include <cstddef>
#include <vector>

namespace carom {

// v.resize(n), but with a reserve of a quarter if it must allocate. resize and assign may allocate exactly n, and would
// allocate again in every step that has one contact more.
template <class T>
void resize_amply(std::vector<T>& v, std::size_t n) {
  if (n > v.capacity()) v.reserve(n + n / 4);
  v.resize(n);
}

template <class T>
void assign_amply(std::vector<T>& v, std::size_t n, const T& value) {
  if (n > v.capacity()) v.reserve(n + n / 4);
  v.assign(n, value);
}

}  // namespace carom
