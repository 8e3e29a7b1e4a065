#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "io/files/output_file.hpp"
#include "io/plots/gnuplot_run.hpp"
#include "parallel/simulation.hpp"
#include "tests/stability/map.hpp"
#include "tests/stability/map_frame.hpp"

namespace carom::stability {

namespace {

// N disks on a line in a ring, with gaps of a diameter and velocities along the line, uniform in [-1, 1].
constexpr int columns = 18;  // N = 3, 4, 6, 8, 12, 16 ... 1024
constexpr int rows = 15;     // 1 - e = 1, 10^(-1/6), ... 10^(-14/6)
constexpr double rows_a_decade = 6.0;
constexpr int seeds = 8;
constexpr double t_end = 200.0;  // large rings near the boundary would collapse even later

int disks_of(int column) {
  return column == 0 ? 3 : column % 2 == 1 ? 4 << (column / 2) : 6 << (column / 2 - 1);
}

double restitution_of(int row) {
  return 1.0 - std::pow(10.0, -row / rows_a_decade);
}

struct Cell {
  int column = 0, row = 0;
  int collapsed = 0;        // of all seeds
  double collisions = 0.0;  // for each disk, before the collapse; mean over the runs that collapse
  double first = t_end;     // the earliest collapse
};

// The velocities for a seed in TOML, by a linear congruential generator, so that every machine gets the same map.
std::string ring(int n, double e, int seed) {
  std::uint64_t state = static_cast<std::uint64_t>(seed) + 1;
  std::string positions;
  std::string velocities;
  for (int k = 0; k < n; ++k) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const double v = static_cast<double>(state >> 11U) * 0x1p-52 - 1.0;
    positions += fmt::format("[{}, 2.0],", 2.0 * k + 1.0);
    velocities += fmt::format("[{}, 0.0],", v);
  }
  return fmt::format(
      "[box]\nwidth = {}\nheight = 4.0\nleft = \"periodic\"\nright = \"periodic\"\n[physics]\n"
      "restitution = {}\n[[disks]]\ncount = {}\npositions = [{}]\nvelocities = [{}]\nradius = 0.5\n"
      "mass = 1.0\n[run]\nmethod = \"exact\"\nt_end = {}\n",
      2.0 * n, e, n, positions, velocities, t_end);
}

void run_ring(int n, double e, int seed, Cell& cell) {
  const Scene scene = parse_scene(ring(n, e, seed), "map", "");
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1});
  engine->forget_paths();
  try {
    while (engine->state().time < scene.run.t_end) engine->step();
  } catch (const PhysicsError&) {
    ++cell.collapsed;
    cell.collisions += 2.0 * static_cast<double>(engine->state().counters.collisions) / n;
    cell.first = std::min(cell.first, engine->state().time);
  }
}

std::vector<Cell> measure_cells() {
  std::vector<Cell> cells;
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      Cell cell{column, row, 0, 0.0, t_end};
      for (int seed = 0; seed < seeds; ++seed) run_ring(disks_of(column), restitution_of(row), seed, cell);
      if (cell.collapsed > 0) cell.collisions /= cell.collapsed;
      cells.push_back(cell);
    }
  }
  return cells;
}

// ln(4 / (1 - e)) / (1 - e) (McNamara and Young 1996), in units of cells.
double column_of_theory(double row) {
  const double q = std::pow(10.0, -row / rows_a_decade);
  const double n = std::log(4.0 / q) / q;
  return 1.0 + 2.0 * std::log2(n / 4.0);
}

std::string data_of(const std::vector<Cell>& cells) {
  std::string text;
  for (const Cell& c : cells) {
    text += fmt::format("{} {} {}\n", c.column, c.row, static_cast<double>(c.collapsed) / seeds);
  }
  text += "\n\n";
  for (double row = -0.5; row < rows - 0.4; row += 0.1) {
    const double column = column_of_theory(row);
    if (column > -0.5 && column < columns - 0.5) text += fmt::format("{} {}\n", column, row);
  }
  return text;
}

std::string script_of() {
  Axis x{"disks on a ring", {}};
  Axis y{"restitution e", {}};
  for (int k = 0; k < columns; ++k) x.labels.push_back(k % 2 == 1 || k == 0 ? std::to_string(disks_of(k)) : "");
  for (int k = 0; k < rows; ++k) y.labels.push_back(fmt::format("{:.3g}", restitution_of(k)));
  return map_header(820, 600) + map_axes("Inelastic collapse of exact, without its remedy", x, y) +
         "set margins 11, 16, 4.5, 3\nset cbrange [0:1]\nset cbtics ('none' 0, 'half' 0.5, 'all' 1)\n"
         "set cblabel 'share of runs that collapse, and stop with status 3' offset 1.5\n"
         "plot 'data' index 0 using 1:2:(0.48):(0.48):3 with boxxyerror fc palette, "
         "'' index 1 with lines lw 2 lc rgb '#d95f02'\n";
}

}  // namespace

void write_collapse_map(const std::string& folder) {
  const std::vector<Cell> cells = measure_cells();
  std::string csv = "disks,restitution,runs,collapsed,collisions_a_disk_before,earliest\n";
  for (const Cell& c : cells) {
    csv += fmt::format("{},{},{},{},{},{}\n", disks_of(c.column), restitution_of(c.row), seeds, c.collapsed,
                       c.collisions, c.first);
  }
  write_file(folder + "/stability_collapse.csv", csv);
  run_gnuplot(script_of(), data_of(cells), {{"plot.svg", folder + "/stability_collapse.svg"}});
}

}  // namespace carom::stability
