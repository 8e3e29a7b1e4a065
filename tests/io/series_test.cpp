// series.csv: columns, interval means, and full disks.
#include "io/tables/series.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "io/tables/group_columns.hpp"
#include "io/tables/rotation_columns.hpp"
#include "io/tables/side_columns.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

Scene small_scene() {
  Scene scene;
  scene.box.width = 4.0;
  scene.box.height = 5.0;
  scene.physics.gravity = 2.0;
  return scene;
}

using Row = std::map<std::string, double>;

std::vector<Row> read_csv(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::size_t column = 0;
    if (!names.empty()) rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      if (rows.empty()) {
        names.push_back(cell);
      } else {
        rows.back()[names.at(column++)] = std::stod(cell);
      }
    }
  }
  return rows;
}

TEST(Series, RowsHoldStateAndIntervalMeans) {
  const test::TestFolder folder("series");
  const std::string path = folder.path() / "series.csv";
  Disks d;
  append(d, {1.0, 1.5, 3.0, 0.0, 0.5, 2.0, 0});
  append(d, {3.0, 0.5, 0.0, -1.0, 0.5, 4.0, 1});
  State state;
  SeriesWriter series(path, small_scene());
  series.write(d, 0.0, state);
  state.time = 0.5;
  state.counters.disk_time = 1.5;  // both disks, and a third one for half of the time
  state.counters.collisions = 3;
  state.counters.wall_collisions = 5;
  state.counters.virial = 8.0;
  state.counters.wall_impulse[2] = 6.0;
  series.write(d, 0.5, state);
  state.time = 1.0;
  state.counters.disk_time = 2.5;
  state.counters.collisions = 4;
  state.counters.removed = 7;
  series.write(d, 1.0, state);
  series.write(d, 1.0, state);  // a frame of exact in the same window as the one before
  series.close();

  auto rows = read_csv(path);
  ASSERT_EQ(rows.size(), 4U);
  for (const char* const mean : {"pressure", "collision_rate", "force_bottom"}) EXPECT_EQ(rows[3][mean], rows[2][mean]);
  EXPECT_EQ(rows[0]["disks"], 2.0);
  EXPECT_EQ(rows[0]["kinetic"], 11.0);
  EXPECT_EQ(rows[0]["potential"], 10.0);
  EXPECT_EQ(rows[0]["total"], 21.0);
  EXPECT_EQ(rows[0]["px"], 6.0);
  EXPECT_EQ(rows[0]["py"], -4.0);
  EXPECT_EQ(rows[0]["pressure"], 0.0);
  EXPECT_EQ(rows[1]["t"], 0.5);
  EXPECT_EQ(rows[1]["pressure"], (11.0 + 8.0 / (2.0 * 0.5)) / 20.0);
  EXPECT_EQ(rows[1]["collision_rate"], 2.0 * 3.0 / 1.5);
  EXPECT_EQ(rows[1]["force_bottom"], 12.0);
  EXPECT_EQ(rows[1]["wall_collisions"], 5.0);
  EXPECT_EQ(rows[2]["pressure"], 11.0 / 20.0);
  EXPECT_EQ(rows[2]["collision_rate"], 2.0);
  EXPECT_EQ(rows[2]["removed"], 7.0);
  EXPECT_EQ(rows[2]["max_overlap"], 0.0);
}

// A series continued from a mark has the rows of a run that was never stopped, whatever was written after the mark: the
// means of its first row include all time since the last row before the mark.
TEST(Series, GoesOnFromAMark) {
  const test::TestFolder folder("series_mark");
  const auto write = [&](SeriesWriter& series, int k) {
    State state;
    state.time = state.counters.disk_time = 0.5 * k * k;
    state.counters.virial = 3.0 * k;
    state.counters.collisions = static_cast<Count>(2 * k);
    state.counters.wall_impulse[1] = 5.0 * k;
    series.write(test::disks_of({{1.0, 1.5, 3.0, 0.0, 0.5, 2.0}}), state.time, state);
  };
  const std::string whole = folder.path() / "whole.csv", stopped = folder.path() / "stopped.csv";
  SeriesWriter series(whole, small_scene());
  for (int k = 0; k < 4; ++k) write(series, k);
  SeriesMark mark;
  {
    SeriesWriter before(stopped, small_scene());
    for (int k = 0; k < 2; ++k) write(before, k);
    mark = before.mark();
    EXPECT_EQ(mark.file.frames, 2U);
    write(before, 9);
    before.close();
  }
  SeriesWriter after(stopped, small_scene(), mark);
  for (int k = 2; k < 4; ++k) write(after, k);
  EXPECT_EQ(after.mark().file.frames, 4U);
  EXPECT_EQ(test::text_of(stopped), test::text_of(whole));
}

TEST(Series, WithoutDisksEveryNumberIsFinite) {
  const test::TestFolder folder("series");
  const std::string path = folder.path() / "series.csv";
  State state;
  SeriesWriter series(path, small_scene());
  series.write({}, 0.0, state);
  state.time = 1.0;
  series.write({}, 1.0, state);
  series.close();
  EXPECT_THAT(test::text_of(path), ::testing::Not(::testing::HasSubstr("nan")));
}

TEST(Series, AFullDiskIsAnError) {
  SeriesWriter series("/dev/full", small_scene());
  EXPECT_THROW(series.write({}, 0.0, {}), RunError);
}

// Forces are means since the previous row: impulses 4, 6, 8, 10 in 2 units of time.
TEST(SeriesColumns, ForcesAreMeansSinceTheRowBefore) {
  const Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 10.0);
  SeriesMeter meter(scene, false);
  const Disks none;
  State now;
  for (std::size_t s = 0; s < 4; ++s) now.counters.wall_impulse[s] = 1.0 + static_cast<double>(s);
  now.time = 1.0;
  meter.row(WholeDisks(none, now.time), now, run_in_order);
  for (std::size_t s = 0; s < 4; ++s) now.counters.wall_impulse[s] += 4.0 + 2.0 * static_cast<double>(s);
  now.time = 3.0;
  const SeriesRow row = meter.row(WholeDisks(none, now.time), now, run_in_order);
  std::size_t side = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (!std::string(series_columns[k].name).starts_with("force")) continue;
    EXPECT_EQ(row[k], 2.0 + static_cast<double>(side++)) << series_columns[k].name;
  }
  EXPECT_EQ(side, 4U);
}

// Rotation has one degree of freedom, so T is twice the mean energy. Walls gave work, and momentum along x and y.
TEST(SeriesColumns, RotationAndPushesAreTheirOwn) {
  Disks disks;
  disks.inertia = 0.5;
  for (DiskId id = 0; id < 2; ++id) append(disks, {1.0 + id, 1.0, 0.0, 0.0, 1.0, 2.0, id, 3.0});
  EXPECT_EQ(rotation_column_values(WholeDisks(disks, 0.0), run_in_order), (std::vector<double>{9.0, 9.0}));
  Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 10.0);
  scene.box.inner_walls_move = true;
  Counters counters;
  counters.wall_work = 1.0;
  counters.wall_push[0] = 2.0;
  counters.wall_push[1] = 3.0;
  EXPECT_EQ(side_column_values(EnergySources(scene), counters), (std::vector<double>{1.0, 2.0, 3.0}));
}

// At heights 3 and 2 of 4 a flow of rate 0.5 has speeds 0.5 and 0: relative to it the disks have (1, 2) and (-1, 1).
// With the opposite rate the flow is reversed, and so is the sign of the viscosity, as the stress is the same.
TEST(SeriesColumns, InAShearTemperatureAndStressAreOfMotionRelativeToTheFlow) {
  for (const double rate : {0.5, -0.5}) {
    Scene scene = test::scene_of(Method::exact, 10.0, 4.0, 0.0, 10.0);
    test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
    scene.box.shear.rate = rate;
    scene.box.shear.jump = 4.0 * rate;
    const Disks disks = test::disks_of({{2.0, 3.0, 1.0 + rate, 2.0, 0.5, 2.0}, {6.0, 2.0, -1.0, 1.0, 0.5, 2.0}});
    SeriesMeter meter(scene, false);
    State now;
    now.counters.shear_virial = 3.0;
    now.counters.virial = 5.0;
    now.time = 1.0;
    meter.row(WholeDisks(disks, now.time), now, run_in_order);
    now.counters.shear_virial = 11.0;
    now.counters.virial = 21.0;
    now.time = 3.0;
    const SeriesRow row = meter.row(WholeDisks(disks, now.time), now, run_in_order);
    const double relative = 5.0 + 2.0;
    const double stress = -(2.0 * (1.0 * 2.0 - 1.0 * 1.0) + 8.0 / 2.0) / 40.0;
    EXPECT_THAT(meter.shear_row(), testing::ElementsAre(stress, stress / rate, relative / 2.0, 0.0));
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (std::string(series_columns[k].name) != "pressure") continue;
      EXPECT_DOUBLE_EQ(row[k], (relative + 16.0 / 4.0) / 40.0);
    }
  }
}

// The temperature of a group, too, is that of the same disks without a flow. Its mean velocity and its energy include
// the flow.
TEST(SeriesColumns, InAShearTheTemperatureOfAGroupIsOfMotionRelativeToTheFlow) {
  Scene scene = test::scene_of(Method::exact, 10.0, 4.0, 0.0, 10.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.groups.resize(1);
  scene.groups[0].count = 2;
  scene.groups[0].name = "all";
  const auto row_of = [&scene](const Disks& disks) {
    Row row;
    const GroupMeter meter(scene);
    const std::vector<double> values = meter.row(disks);
    const std::vector<GroupColumn> columns = meter.columns();
    for (std::size_t k = 0; k < values.size(); ++k) row[columns.at(k).name] = values[k];
    return row;
  };
  Row at_rest = row_of(test::disks_of({{2.0, 3.0, 1.0, 2.0, 0.5, 2.0}, {6.0, 2.0, -1.0, 1.0, 0.5, 2.0}}));
  scene.box.shear.rate = 0.5;
  scene.box.shear.jump = 2.0;
  Row sheared = row_of(test::disks_of({{2.0, 3.0, 1.5, 2.0, 0.5, 2.0}, {6.0, 2.0, -1.0, 1.0, 0.5, 2.0}}));
  EXPECT_GT(sheared["temperature_all"], 0.0);
  EXPECT_EQ(sheared["temperature_all"], at_rest["temperature_all"]);
  EXPECT_EQ(sheared["vx_all"], 0.25);
  EXPECT_EQ(sheared["kinetic_all"], 0.5 * 2.0 * (1.5 * 1.5 + 4.0 + 1.0 + 1.0));
}

// At time 0.5 the upper images have moved by 1: then the image of one disk is above the other and overlaps it by a
// quarter of the sum of the radii.
TEST(SeriesColumns, OverlapsAreThoseOfTheBoxAtTheTimeOfTheRow) {
  Scene scene = test::scene_of(Method::pairwise, 10.0, 4.0, 0.1, 10.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.box.shear.rate = 0.5;
  scene.box.shear.jump = 2.0;
  const Disks disks = test::disks_of({{3.0, 0.25, 0.0, 0.0, 0.5, 1.0}, {4.0, 3.5, 0.0, 0.0, 0.5, 1.0}});
  SeriesMeter meter(scene, true);
  const auto overlap_at = [&](double time) {
    State now;
    now.time = time;
    const SeriesRow row = meter.row(WholeDisks(disks, time), now, run_in_order);
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (std::string(series_columns[k].name) == "max_overlap") return row[k];
    }
    return -1.0;
  };
  EXPECT_EQ(overlap_at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(overlap_at(0.5), 0.25);
}

// The names of all columns in their order, with each value under its own name.
TEST(Series, ValuesStandUnderTheirNames) {
  Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 10.0);
  scene.box.temperatures[0] = 1.0;
  scene.box.sides[1] = SideKind::sink;
  scene.walls.resize(2);
  scene.walls[1].sink = true;
  scene.box.motions[3] = {SideMotion::Kind::steady, 0.0, 0.5};
  scene.box.inner_walls_move = true;
  scene.physics.thermostat.kind = Thermostat::Kind::langevin;
  scene.physics.surfaces.inertia = 0.5;
  scene.analysis.wanted[static_cast<std::size_t>(Quantity::displacement)] = true;
  scene.groups.resize(1);
  scene.groups[0].count = 1;
  scene.groups[0].name = "one";
  Disks disks;
  disks.inertia = 0.5;
  append(disks, {5.0, 6.0, 3.0, 4.0, 1.0, 2.0, 0, 3.0});
  State state;
  state.taken = {0, 11, 0, 0, 0, 12};
  state.counters.side_energy[0] = 1.5;
  state.counters.side_energy[3] = 4.5;
  state.counters.wall_work = 5.5;
  state.counters.wall_push[0] = 6.5;
  state.counters.wall_push[1] = 7.5;
  state.counters.thermostat_heat = 8.5;
  state.counters.collisions = 5'000'000'000;
  const test::TestFolder folder("series_names");
  const std::string path = folder.path() / "series.csv";
  SeriesWriter series(path, scene);
  series.write(disks, 0.1 + 0.2, state, 9.5);
  series.close();
  const std::string text = test::text_of(path);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "t,disks,kinetic,potential,total,px,py,collisions,wall_collisions,pressure,collision_rate,max_overlap,"
            "removed,emitted,waiting,force_left,force_right,force_bottom,force_top,displacement,removed_by_right,"
            "removed_by_walls.1,heat_left,work_top,wall_work,wall_push_x,wall_push_y,thermostat_heat,rotational,"
            "rotational_temperature,disks_one,kinetic_one,temperature_one,vx_one,vy_one,x_one,y_one");
  EXPECT_THAT(text, ::testing::HasSubstr("\n0.30000000000000004,1,25,")) << "all digits of the time";
  auto row = read_csv(path).at(0);
  EXPECT_EQ(row["collisions"], 5e9);
  EXPECT_EQ(row["displacement"], 9.5);
  EXPECT_EQ(row["removed_by_right"], 11.0);
  EXPECT_EQ(row["removed_by_walls.1"], 12.0);
  EXPECT_EQ(row["heat_left"], 1.5);
  EXPECT_EQ(row["work_top"], 4.5);
  EXPECT_EQ(row["wall_work"], 5.5);
  EXPECT_EQ(row["wall_push_x"], 6.5);
  EXPECT_EQ(row["wall_push_y"], 7.5);
  EXPECT_EQ(row["thermostat_heat"], 8.5);
  EXPECT_EQ(row["rotational"], 0.5 * 0.5 * 2.0 * 9.0);
  EXPECT_EQ(row["kinetic_one"], 25.0);
  EXPECT_EQ(row["vy_one"], 4.0);
  EXPECT_EQ(row["x_one"], 5.0);
  EXPECT_EQ(row["y_one"], 6.0);
}

// At the end of the interval the lid is at 4 of 10.
TEST(SeriesColumns, ThePressureIsThatOfTheBoxAtTheTimeOfTheRow) {
  Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 10.0);
  scene.box.motions[3] = {SideMotion::Kind::steady, 0.0, 3.0};
  SeriesMeter meter(scene, false);
  const Disks disks = test::disks_of({{2.0, 3.0, 3.0, 4.0, 0.5, 2.0}});
  State now;
  now.time = 2.0;
  const SeriesRow row = meter.row(WholeDisks(disks, now.time), now, run_in_order);
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (std::string(series_columns[k].name) != "pressure") continue;
    EXPECT_DOUBLE_EQ(row[k], 25.0 / (10.0 * 4.0));
  }
}

// Quantities computed from velocities that are drawn in each step have no meaning.
TEST(SeriesColumns, OfBrownianDisksWhatVelocitiesGiveIsNoNumber) {
  Scene scene = test::scene_of(Method::pairwise, 10.0, 10.0, 0.1, 10.0);
  scene.physics.diffusion = 1.0;
  SeriesMeter meter(scene, false);
  State now;
  now.time = 1.0;
  now.counters.wall_impulse[0] = 1.0;
  const SeriesRow row =
      meter.row(WholeDisks(test::disks_of({{2.0, 3.0, 3.0, 4.0, 0.5, 2.0}}), now.time), now, run_in_order);
  for (std::size_t k = 0; k < row.size(); ++k) {
    const std::string name = series_columns[k].name;
    const bool of_velocities = name == "kinetic" || name == "total" || name == "px" || name == "py" ||
                               name == "pressure" || name.starts_with("force");
    EXPECT_EQ(std::isnan(row[k]), of_velocities) << name;
  }
}

// A series begun by an earlier version lacks columns added since, and once got rows that included them.
TEST(Series, GoesOnWithItsOwnColumnsAlone) {
  const test::TestFolder folder("series_columns");
  const std::string path = folder.path() / "series.csv";
  SeriesMark mark;
  {
    SeriesWriter series(path, small_scene());
    series.write(Disks{}, 0.0, State{});
    mark = series.mark();
  }
  Scene other = small_scene();
  other.physics.surfaces.inertia = 0.5;
  EXPECT_THROW(SeriesWriter(path, other, mark), InputError);
  EXPECT_EQ(read_csv(path).size(), 1U) << "the file must be unchanged";
  SeriesWriter(path, small_scene(), mark).write(Disks{}, 1.0, State{});
  EXPECT_EQ(read_csv(path).size(), 2U);
}

// A file cut within its header is too short, and must not be reported as one with wrong columns.
TEST(Series, OneThatWasCutInItsHeadingIsTooShort) {
  const test::TestFolder folder("series_cut");
  const std::string path = folder.path() / "series.csv";
  SeriesMark mark;
  {
    SeriesWriter series(path, small_scene());
    series.write(Disks{}, 0.0, State{});
    mark = series.mark();
  }
  std::filesystem::resize_file(path, 20);
  try {
    const SeriesWriter going_on(path, small_scene(), mark);
    FAIL() << "the series was continued";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("has 20 bytes; expected "));
  }
}

}  // namespace
}  // namespace carom
