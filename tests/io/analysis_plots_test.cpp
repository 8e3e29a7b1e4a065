// The plots of [analysis] show all that there is.
#include "io/plots/analysis_plots.hpp"

#include <gmock/gmock.h>

#include "core/load/scene_file.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::HasSubstr;

// Wave numbers are multiples of 2 pi / 5 along x, and of 2 pi / 20 along y; or the other way round.
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
    // The last are at 12.6 and 3.1: the axis has a number beside each even one.
    const std::string svg = test::text_of(folder.path() / "structure_factor.svg");
    for (const char* const shown : {">12<", ">along x<", ">along y<", ">ideal gas<"}) {
      EXPECT_THAT(svg, HasSubstr(shown)) << box;
    }
  }
}

}  // namespace
}  // namespace carom
