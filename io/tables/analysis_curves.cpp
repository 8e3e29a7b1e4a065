#include "io/tables/analysis_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/input_message.hpp"
#include "io/hdf5/hdf5_handle.hpp"

namespace carom {

namespace {

constexpr const char* sample_times = "/samples/time";

struct KnownCurve {
  const char *name, *group, *x, *y;  // x: in the group; if none, the times of samples
};

constexpr std::array known_curves{KnownCurve{"g(r)", "/pair_correlation", "r", "g"},
                                  KnownCurve{"g6(r)", "/bond_correlation", "r", "g6"},
                                  KnownCurve{"S(kx)", "/structure_factor", "kx", "along_x"},
                                  KnownCurve{"S(ky)", "/structure_factor", "ky", "along_y"},
                                  KnownCurve{"speeds (u)", "/speeds", "u", "measured"},
                                  KnownCurve{"packing fraction (position)", "/density", "position", "packing_fraction"},
                                  KnownCurve{"mean vx (position)", "/profile", "position", "velocity_x"},
                                  KnownCurve{"mean vy (position)", "/profile", "position", "velocity_y"},
                                  KnownCurve{"temperature (position)", "/profile", "position", "temperature"},
                                  KnownCurve{"mean square displacement", "/displacement", nullptr, "mean_square"},
                                  KnownCurve{"mean v(0) v(t)", "/velocity_autocorrelation", nullptr, "value"},
                                  KnownCurve{"g6(t)", "/bond_autocorrelation", nullptr, "value"},
                                  KnownCurve{"psi6, local", "/bond_order", nullptr, "local"},
                                  KnownCurve{"psi6, global", "/bond_order", nullptr, "global"},
                                  KnownCurve{"pressure of samples", "/pressure", nullptr, "value"},
                                  KnownCurve{"collision rate", "/collision_rate", nullptr, "value"}};

// The numbers of a dataset of one dimension; none if there is no such dataset.
std::vector<double> numbers_of(const Hdf5Handle& file, const std::string& path, const std::string& name) {
  const std::size_t slash = path.rfind('/');
  if (H5Lexists(file.get(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return {};
  if (H5Lexists(file.get(), path.c_str(), H5P_DEFAULT) <= 0) return {};
  const auto fail = [&] { fail_input(name, fmt::format("{}: {}", path, hdf5_reason()), "expected numbers"); };
  const Hdf5Handle set{H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Dclose};
  if (!set.valid()) fail();
  const Hdf5Handle space{H5Dget_space(set.get()), H5Sclose};
  if (!space.valid() || H5Sget_simple_extent_ndims(space.get()) != 1) fail();
  std::vector<double> numbers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  if (!numbers.empty() && H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    fail();
  }
  return numbers;
}

std::vector<double> every(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> chosen;
  for (std::size_t k = 0; k < values.size(); k += stride) chosen.push_back(values[k]);
  return chosen;
}

}  // namespace

std::vector<AnalysisCurve> read_analysis_curves(const std::string& path, std::size_t most_points) {
  silence_hdf5();
  const Hdf5Handle file{H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  if (!file.valid())
    fail_input(path, fmt::format("cannot be read: {}", hdf5_reason()), "expected analysis.h5 of a run");
  std::vector<AnalysisCurve> curves;
  for (const KnownCurve& known : known_curves) {
    const std::string group = std::string(known.group) + "/";
    const std::vector<double> y = numbers_of(file, group + known.y, path);
    const std::vector<double> x = numbers_of(file, known.x != nullptr ? group + known.x : sample_times, path);
    if (y.size() < 2 || x.size() != y.size()) continue;
    const std::size_t stride = 1 + (y.size() - 1) / std::max<std::size_t>(2, most_points);
    const std::string chosen = stride > 1 ? fmt::format(", 1 point of {}", stride) : "";
    curves.push_back({known.name + chosen, every(x, stride), every(y, stride), known.x == nullptr});
  }
  return curves;
}

}  // namespace carom
