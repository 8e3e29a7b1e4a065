// The frame of a trajectory from which a scene starts: by number, by time, or the last one if neither is given.
#include "io/trajectory/scene_frame_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/check.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::ElementsAre;

class SceneFrames : public ::testing::Test {
 protected:
  // A trajectory with a disk at x = number of the frame, at these times.
  std::string with_times(const std::vector<double>& times) const {
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k) {
      text += fmt::format(
          "1\nLattice=\"10 0 0 0 8 0 0 0 1\" pbc=\"F F F\" "
          "Properties=pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1:spin:R:1 Time={}\n{} 2 3 4 0.5 6 0 7\n",
          times[k], k + 1);
    }
    return folder_.write("trajectory.xyz", text);
  }
  static double x_of(const FrameAsked& asked) { return read_scene_frame(asked).positions.at(0).x; }
  static std::string complaint(const FrameAsked& asked) {
    try {
      read_scene_frame(asked);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  const test::TestFolder folder_{"scene_frames"};
};

TEST_F(SceneFrames, HasAllThatADiskHas) {
  const SceneFrame frame = read_scene_frame({with_times({0.0}), {}, {}});
  ASSERT_EQ(frame.positions.size(), 1U);
  EXPECT_EQ(frame.positions[0].y, 2.0);
  EXPECT_EQ(frame.velocities.at(0).x, 3.0);
  EXPECT_EQ(frame.velocities.at(0).y, 4.0);
  EXPECT_THAT(frame.radius, ElementsAre(0.5));
  EXPECT_THAT(frame.mass, ElementsAre(6.0));
  EXPECT_THAT(frame.spin, ElementsAre(7.0));
}

TEST_F(SceneFrames, IsTheOneAskedFor) {
  const std::string file = with_times({0.0, 1.0, 2.0, 4.0});
  EXPECT_EQ(x_of({file, {}, {}}), 4.0);
  for (Count k = 1; k <= 4; ++k) EXPECT_EQ(x_of({file, k, {}}), static_cast<double>(k));
  EXPECT_EQ(x_of({file, {}, 1.2}), 2.0);
  EXPECT_EQ(x_of({file, {}, 2.9}), 3.0);
  EXPECT_EQ(x_of({file, {}, 3.0}), 3.0) << "of two equally near ones the earlier";
  EXPECT_EQ(x_of({file, {}, 4.0 + 1e-12}), 4.0) << "rounding must not matter";
  EXPECT_EQ(x_of({folder_.path().string(), 2, {}}), 2.0) << "in the folder of a run";
}

TEST_F(SceneFrames, OneThatIsNotThereIsNamed) {
  const std::string file = with_times({0.0, 1.0});
  EXPECT_EQ(complaint({file, 3, {}}), file + ": there is no frame 3; expected 1 to 2");
  EXPECT_EQ(complaint({file, 30, {}}), file + ": there is no frame 30; expected 1 to 2");
  EXPECT_EQ(complaint({file, {}, 9.0}),
            file + ": has no frame at t = 9; expected a time from 0 to 1, that of the last frame");
  EXPECT_EQ(complaint({with_times({0.5, 1.0}), {}, 0.25}),
            file + ": has no frame at t = 0.25; expected a time from 0.5 to 1, that of the last frame");
  with_times({});
  EXPECT_EQ(complaint({file, {}, {}}), file + ": holds no frame");
  EXPECT_EQ(complaint({file, {}, 1.0}), file + ": holds no frame");
}

TEST_F(SceneFrames, OfARunThatIsNotFinishedItsTrajectoryIsToBeNamed) {
  const std::string folder = folder_.path().string();
  EXPECT_EQ(complaint({folder, {}, {}}),
            folder + ": holds no trajectory.xyz or trajectory.h5; expected a run with a trajectory");
  const std::string file = with_times({0.0, 1.0});
  const std::filesystem::path inside = folder_.path() / "carom-unfinished";
  std::filesystem::create_directories(inside);
  std::filesystem::rename(file, inside / "trajectory.xyz");
  const std::string moved = (inside / "trajectory.xyz").string();
  EXPECT_EQ(complaint({folder, {}, {}}),
            folder + ": holds a run that is not finished; expected a finished one, or the trajectory " + moved);
  EXPECT_EQ(x_of({moved, {}, {}}), 2.0);
}

// A group is found by the name that the scene beside the file gives to it, and by ids, which go on from group to group:
// a file with one group only does not number them.
TEST_F(SceneFrames, ShowsOneGroupAlone) {
  const auto radii = [this](const char* group) {
    return read_scene_frame({folder_.path().string(), {}, {}, false, group}).radius;
  };
  const auto message = [this](const char* group) { return complaint({folder_.path().string(), {}, {}, false, group}); };
  const std::string file = folder_.write(
      "trajectory.xyz",
      "3\nLattice=\"10 0 0 0 8 0 0 0 1\" pbc=\"F F F\" Properties=pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=0\n"
      "1 2 0 0 0.25 1 0\n3 2 0 0 0.5 1 2\n5 2 0 0 0.75 1 3\n");
  EXPECT_EQ(message("a"), file + ": does not know a group \"a\"; expected the folder of a run, with its scene.toml");
  const auto block = [](const char* name, int x, const char* more) {
    return fmt::format("[[disks]]\nname = \"{}\"\ncount = 1\npositions = [[{}, 2]]\nradius = 0.25\n{}", name, x, more);
  };
  folder_.write("scene.toml",
                "[box]\nwidth = 10\nheight = 8\n" + block("a", 1, "mass = 1\n") + block("pegs", 3, "fixed = true\n") +
                    block("b", 5, "mass = 1\n") +
                    "[[sources]]\nside = \"left\"\nrate = 1\nradius = 0.25\nmass = 1\n[run]\nt_end = 1\n");
  EXPECT_THAT(radii("a"), ElementsAre(0.25));
  EXPECT_THAT(radii("b"), ElementsAre(0.5));
  EXPECT_THAT(radii("sources"), ElementsAre(0.75));
  EXPECT_THAT(radii(""), ElementsAre(0.25, 0.5, 0.75));
  EXPECT_EQ(message("c"), file + ": does not know a group \"c\"; expected one of a, b, sources");
  EXPECT_EQ(message("pegs"), file + ": does not know a group \"pegs\"; expected one of a, b, sources");
}

// The velocities written by a run with shear include the flow. Its rate is taken from the scene beside the file, if
// that is the run's own. A run with shear counts no rounds, so a frame with rounds is from a run without it.
TEST_F(SceneFrames, TellsTheShearOfItsRun) {
  const auto frame = [this](const char* sides, const char* column, const char* value) {
    folder_.write("trajectory.xyz",
                  fmt::format("1\nLattice=\"10 0 0 0 8 0 0 0 1\" pbc=\"{} F\" Properties=pos:R:2:velo:"
                              "R:2:radius:R:1:mass:R:1:id:I:1{} Time=0\n1 2 3 4 0.5 6 0{}\n",
                              sides, column, value));
    return read_scene_frame({folder_.path().string(), {}, {}, true});
  };
  const auto scene = [this](double height, std::string_view more) {
    folder_.write("scene.toml",
                  fmt::format("[box]\nwidth = 10\nheight = {}\nleft = \"periodic\"\nright = \"periodic\"\n"
                              "bottom = \"periodic\"\ntop = \"periodic\"\n{}[[disks]]\ncount = 1\n"
                              "positions = [[1, 2]]\nradius = 0.5\nmass = 6\n[run]\nt_end = 1\n",
                              height, more));
  };
  EXPECT_EQ(frame("T T", "", "").shear_rate, std::nullopt) << "there is no scene with the rate";
  EXPECT_EQ(frame("T F", "", "").shear_rate, 0.0);
  EXPECT_EQ(frame("T T", ":map_shift:I:2", " 0 0").shear_rate, 0.0);
  scene(8, "shear_rate = 0.25\n");
  EXPECT_EQ(frame("T T", "", "").shear_rate, 0.25);
  EXPECT_EQ(frame("T T", "", "").height, 8.0);
  EXPECT_EQ(frame("T T", "", "").velocities.at(0).x, 3.0) << "as they were written";
  scene(8, "");
  EXPECT_EQ(frame("T T", "", "").shear_rate, 0.0);
  scene(9, "shear_rate = 0.25\n");
  EXPECT_EQ(frame("T T", "", "").shear_rate, std::nullopt) << "the scene has another box";
  folder_.write("scene.toml", "[box\n");
  EXPECT_EQ(frame("T T", "", "").shear_rate, std::nullopt);
}

// Velocities may be those of drawn displacements; the scene beside the file tells.
TEST_F(SceneFrames, TellsThatItsDisksAreBrownian) {
  with_times({0.0});
  const auto brownian = [this](std::string_view physics) {
    folder_.write("scene.toml", fmt::format("[box]\nwidth = 10\nheight = 8\n{}[[disks]]\ncount = 1\n"
                                            "positions = [[1, 2]]\nradius = 0.5\nmass = 6\n"
                                            "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1\n",
                                            physics));
    return read_scene_frame({folder_.path().string(), {}, {}, true}).brownian;
  };
  EXPECT_FALSE(brownian(""));
  EXPECT_TRUE(brownian("[physics]\ndiffusion = 0.1\n"));
  EXPECT_FALSE(brownian("[physics]\ndiffusion = 0.1\naccumulate = true\n")) << "such disks have velocities";
  EXPECT_FALSE(read_scene_frame({folder_.path().string(), {}, {}, false}).brownian) << "not asked for velocities";
}

}  // namespace
}  // namespace carom
