// The plots of [analysis] show all data.
#include "io/plots/analysis_plots.hpp"

#include <gmock/gmock.h>

#include "core/load/scene_file.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::HasSubstr;

// Wave numbers are multiples of 2 pi / 5 along x, and of 2 pi / 20 along y; or the reverse.
TEST(AnalysisPlots, TheStructureFactorIsShownToTheLastWaveAlongEitherAxis) {
  const test::TestFolder folder("analysis_plots");
  for (const std::string box : {"width = 5.0\nheight = 20.0\n", "width = 20.0\nheight = 5.0\n"}) {
    const Scene scene = parse_scene("[box]\n" + box +
                                        "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
                                        "top = \"periodic\"\n[[disks]]\ncount = 10\npositions = \"random\"\n"
                                        "radius = 0.1\nmass = 1.0\n[run]\nmethod = \"exact\"\nt_end = 1.0\n"
                                        "[analysis]\nwhat = [\"structure_factor\"]\n"
                                        "structure_factor = { wave_numbers = 10 }\n",
                                    "scene", "");
    AnalysisRecord record = empty_record(scene);
    record.structure.along_x.assign(10, 1.0);
    record.structure.along_y.assign(10, 2.0);
    record.structure.samples = 1;
    ASSERT_TRUE(draw_analysis(folder.path().string(), scene, record));
    // The last ones are 12.6 and 3.1; the axis has a number at each even one.
    const std::string svg = test::text_of(folder.path() / "structure_factor.svg");
    for (const char* const shown : {">12<", ">along x<", ">along y<", ">ideal gas<"}) {
      EXPECT_THAT(svg, HasSubstr(shown)) << box;
    }
  }
}

// There are no disks above a bed: the profile ends there, and no data are missing.
TEST(AnalysisPlots, AProfileThatEndsWithTheDisksIsNotGone) {
  const test::TestFolder folder("analysis_profile");
  const Scene scene = parse_scene(
      "[box]\nwidth = 10.0\nheight = 10.0\n[[disks]]\ncount = 10\npositions = \"random\"\nradius = 0.1\nmass = 1.0\n"
      "[run]\nmethod = \"exact\"\nt_end = 1.0\n[analysis]\nwhat = [\"profile\"]\n",
      "scene", "");
  AnalysisRecord record = empty_record(scene);
  for (const std::size_t slab : {0U, 1U, 2U}) {
    record.motion.disks[slab] = 2;
    record.motion.mass[slab] = 2.0;
  }
  record.motion.samples = 1;
  ASSERT_TRUE(draw_analysis(folder.path().string(), scene, record));
  const std::string svg = test::text_of(folder.path() / "profile.svg");
  for (const char* const shown : {">vx<", ">vy<", ">temperature<"}) EXPECT_THAT(svg, HasSubstr(shown));
  EXPECT_THAT(svg, testing::Not(HasSubstr("gone")));
}

}  // namespace
}  // namespace carom
