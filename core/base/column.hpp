// Numbers of a std::vector as a column of Eigen, for what is measured and fitted: never for what decides the bits of a
// run. Eigen is built without vector instructions here (cmake/Dependencies.cmake), so that sums run from the first
// entry to the last on every machine. For .cpp files: it is slow to compile.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace carom {

using Column = Eigen::ArrayXd;

// Precondition: `values` outlives the view and keeps its size.
template <class Number>
Eigen::Map<const Eigen::Array<Number, Eigen::Dynamic, 1>> column_of(const std::vector<Number>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace carom
