// Files written from disks in pieces, as those of several ranks: byte for byte the files of the whole.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/base/random.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/analysis.hpp"
#include "core/measure/displacement.hpp"
#include "core/scene/disk_group.hpp"
#include "io/movie/frame.hpp"
#include "io/plots/plot.hpp"
#include "io/tables/analysis_file.hpp"
#include "io/tables/series.hpp"
#include "io/trajectory/trajectory_h5md.hpp"
#include "io/trajectory/trajectory_xyz.hpp"
#include "tests/support/cut_disks.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

// The disks of frame k: in random order, some of them gone since the frame before.
Disks frame_disks(const Scene& scene, std::uint32_t count, std::uint32_t k) {
  Disks disks;
  if (scene.physics.surfaces.are_rough()) disks.inertia = 0.5;
  for (std::uint32_t place = 0; place < count; ++place) {
    const DiskId id = (place * 7919U) % count;
    const TwoUniforms u = uniforms(3, Stream::position, id, k);
    if (u.a < 0.05 * k) continue;
    append(disks, {u.a * scene.box.width, u.b * scene.box.height, u.b - 0.5, u.a - 0.5, 0.01 + 0.001 * (id % 3), 1.5,
                   id, u.a + u.b});
  }
  return disks;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

// The contents of all files for some frames. ids: number of ids in a piece; 0: the disks as a whole.
std::string files_of(const test::TestFolder& folder, const Scene& scene, std::uint32_t count, std::uint32_t frames,
                     DiskId ids) {
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  DisplacementTally rounds;
  XyzPlan plan{scene.box, scene.output.select};
  plan.rounds = &rounds;
  plan.group_ends = ends_of_groups(scene);
  plan.spins = scene.physics.surfaces.are_rough();
  plan.single = scene.output.single_precision;
  {
    H5mdWriter h5md(path("trajectory.h5"), scene, &rounds);
    XyzWriter xyz(path("trajectory.xyz"), plan);
    SeriesMeter meter(scene, false);
    SeriesWriter series(path("series.csv"), scene);
    for (std::uint32_t k = 0; k < frames; ++k) {
      const Disks all = frame_disks(scene, count, k);
      State now;
      now.time = 0.25 * k;
      now.counters.steps = k;
      now.counters.virial = 3.5 * k;
      const auto write = [&](const DisksInPieces& disks) {
        follow_rounds(rounds, disks, scene.box);
        xyz.write(disks);
        h5md.write(disks, k, meter.row(disks, now));
        // The largest overlap of pieces is given by the ranks; the disks here are too small to overlap.
        if (ids > 0 && disks.max_overlap() != 0.125) ADD_FAILURE();
        series.write(disks, now);
      };
      if (ids == 0) write(WholeDisks(all, now.time));
      if (ids > 0) write(test::CutDisks(all, now.time, ids));
    }
    h5md.close();
    xyz.close();
    series.close();
  }
  std::string files;
  for (const char* name : {"trajectory.h5", "trajectory.xdmf", "trajectory.xyz"}) files += bytes_of(path(name));
  // All columns but the overlaps.
  std::istringstream lines(bytes_of(path("series.csv")));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t column = 0; std::getline(cells, cell, ','); ++column) {
      if (column != 1 + overlap_column) files += cell + ",";
    }
  }
  return files;
}

TEST(LongPieces, FilesAreThoseOfTheWhole) {
  const test::TestFolder folder("pieces");
  const auto scene_with = [](const std::string& box, const std::string& physics, const std::string& output) {
    return parse_scene(fmt::format("[box]\nwidth = 40.0\nheight = 30.0\nleft = \"periodic\"\nright = \"periodic\"\n{}\n"
                                   "[physics]\n{}\n"
                                   "[[disks]]\nname = \"few\"\ncount = 900\npositions = \"random\"\nradius = 0.01\n"
                                   "mass = 1.5\n"
                                   "[[disks]]\ncount = 3100\npositions = \"random\"\nradius = 0.01\nmass = "
                                   "1.5\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n[output]\n"
                                   "every = 0.25\ntrajectory = \"h5md\"\n{}\n",
                                   box, physics, output),
                       "scene", "");
  };
  const std::string shear = "bottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.5";
  for (const Scene& scene : {scene_with("", "gravity = 2.0", ""), scene_with("", "", "select = \"every 7th\""),
                             scene_with("", "", "select = [3.0, 4.0, 21.0, 15.0]"),
                             scene_with("", "roughness = { tangential_restitution = 0.5 }", "dimensions = 3"),
                             scene_with(shear, "", "precision = \"single\"")}) {
    const std::string whole = files_of(folder, scene, 4000, 4, 0);
    for (const DiskId ids : {1U, 100U, 4096U}) {
      EXPECT_TRUE(whole == files_of(folder, scene, 4000, 4, ids)) << scene.output.select.stride << " " << ids;
    }
  }
}

std::string bits(double value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

// The data of pictures and plots: pixels, the ends of the colour scale, velocities. ids: as above.
std::string pictures_of(const Scene& scene, std::uint32_t frames, DiskId ids) {
  VelocityRecord velocities;
  std::string all;
  std::unique_ptr<FramePainter> painter;
  const auto look = [&](const DisksInPieces& disks) {
    record(velocities, disks);
    const SeenValues seen = foreseen_values(scene, disks);
    if (!painter) painter = std::make_unique<FramePainter>(frame_style(scene, scene.output.look, seen));
    painter->paint(disks);
    all.append(reinterpret_cast<const char*>(painter->pixels()), painter->bytes());
    for (const double value : {seen.speed_square, seen.radius.low, seen.radius.high, seen.mass.low, seen.mass.high,
                               static_cast<double>(seen.last_id)}) {
      all += bits(value);
    }
  };
  for (std::uint32_t k = 0; k < frames; ++k) {
    const Disks disks = frame_disks(scene, 4000, k);
    if (ids == 0) look(WholeDisks(disks, 0.25 * k));
    if (ids > 0) look(test::CutDisks(disks, 0.25 * k, ids));
  }
  for (const VelocityBand& band : velocities.bands) {
    for (std::size_t k = 0; k < velocity_levels; ++k) all += bits(band.vx[k]) + bits(band.vy[k]);
  }
  for (const VelocityRecord::Curve& curve : velocities.curves) {
    for (std::size_t k = 0; k < curve.t.size(); ++k) all += bits(curve.t[k]) + bits(curve.vx[k]) + bits(curve.vy[k]);
  }
  return all;
}

TEST(Pieces, PicturesAreThoseOfTheWhole) {
  const auto scene_with = [](const std::string& box, const std::string& colour) {
    return parse_scene(fmt::format("[box]\nwidth = 4.0\nheight = 3.0\nleft = \"periodic\"\nright = \"periodic\"\n{}\n"
                                   "[[disks]]\ncount = 900\npositions = \"random\"\nradius = 0.01\nmass = 1.5\n"
                                   "[[disks]]\ncount = 3100\npositions = \"random\"\nradius = 0.01\nmass = 2.5\n"
                                   "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n[output]\n"
                                   "every = 0.25\nmovie = {{ colour = \"{}\", size = [600, 400] }}\n",
                                   box, colour),
                       "scene", "");
  };
  const std::string shear = "bottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.5";
  for (const Scene& scene : {scene_with("", "speed"), scene_with(shear, "group")}) {
    const std::string whole = pictures_of(scene, 3, 0);
    for (const DiskId ids : {1U, 100U, 4096U}) EXPECT_TRUE(whole == pictures_of(scene, 3, ids)) << ids;
  }
}

// The file of quantities measured in the frames. ids: as above.
std::string samples_of(const test::TestFolder& folder, const Scene& scene, std::uint32_t frames, DiskId ids) {
  AnalysisRecord record = empty_record(scene);
  for (std::uint32_t k = 0; k < frames; ++k) {
    const Disks disks = frame_disks(scene, 9000, k);
    State now;
    now.time = 0.25 * k;
    now.counters.virial = 3.5 * k;
    now.counters.collisions = 7 * k;
    if (ids == 0) take_sample(record, scene, WholeDisks(disks, now.time), now, run_in_order);
    if (ids > 0) take_sample(record, scene, test::CutDisks(disks, now.time, ids), now, run_in_order);
  }
  const std::string path = (folder.path() / "analysis.h5").string();
  write_analysis(path, scene, record);
  return bytes_of(path);
}

TEST(LongPieces, SamplesAreThoseOfTheWhole) {
  const test::TestFolder folder("pieces_samples");
  const auto scene_with = [](const std::string& box, const std::string& analysis) {
    return parse_scene(
        fmt::format("[box]\nwidth = 40.0\nheight = 30.0\nleft = \"periodic\"\nright = \"periodic\"\n{}\n"
                    "[[disks]]\nname = \"few\"\ncount = 900\npositions = \"random\"\nradius = 0.01\nmass = 1.5\n"
                    "[[disks]]\ncount = 8100\npositions = \"random\"\nradius = 0.01\nmass = 1.5\n"
                    "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n[analysis]\n"
                    "what = [\"displacement\", \"speeds\", \"density\", \"pressure\", \"collision_rate\", \"profile\", "
                    "\"velocity_autocorrelation\", \"structure_factor\"]\ndensity = {{ every = 0.5 }}\n"
                    "profile = {{ axis = \"x\", every = 0.5 }}\n{}\n",
                    box, analysis),
        "scene", "");
  };
  const std::string shear = "bottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.5";
  for (const Scene& scene : {scene_with("", ""), scene_with("", "select = \"few\""), scene_with(shear, "")}) {
    const std::string whole = samples_of(folder, scene, 4, 0);
    for (const DiskId ids : {1U, 100U, 4100U}) EXPECT_TRUE(whole == samples_of(folder, scene, 4, ids)) << ids;
  }
}

// More disks than are written to the file at once, with chunks that end within pieces.
TEST(LongPieces, ManyDisksGoChunkByChunk) {
  const test::TestFolder folder("pieces_of_many");
  for (const char* select : {"", "select = \"every 2nd\"\n", "select = [0.0, 0.0, 400.0, 250.0]\n"}) {
    const Scene scene =
        parse_scene(fmt::format("[box]\nwidth = 400.0\nheight = 300.0\nleft = \"periodic\"\nright = \"periodic\"\n"
                                "[physics]\nroughness = {{ tangential_restitution = 0.5, friction = 0.4 }}\n"
                                "[[disks]]\ncount = 140000\npositions = \"square\"\nradius = 0.01\nmass = 1.5\n"
                                "[run]\nmethod = \"exact\"\nt_end = 1.0\n[output]\ntrajectory = \"h5md\"\n{}",
                                select),
                    "scene", "");
    const std::string whole = files_of(folder, scene, 140000, 2, 0);
    EXPECT_TRUE(whole == files_of(folder, scene, 140000, 2, 1U << 15)) << select;
  }
}

}  // namespace
}  // namespace carom
