// trajectory.xdmf: which row of trajectory.h5 belongs to which frame.
#include "io/trajectory/xdmf.hpp"

#include <gmock/gmock.h>

#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::HasSubstr;
using testing::Not;

class Xdmf : public ::testing::Test {
 protected:
  std::string written(const XdmfPlan& plan) const {
    write_xdmf((folder_.path() / "trajectory.h5").string(), plan);
    return test::text_of((folder_.path() / "trajectory.xdmf").string());
  }
  const test::TestFolder folder_{"xdmf"};
};

// Start, stride and length of the row, and then the size of its dataset.
TEST_F(Xdmf, AFrameIsItsRow) {
  const std::string text = written({{0.0, 0.25, 0.1}, 40, 8, 2, false});
  EXPECT_THAT(text, HasSubstr("<Time Value=\"0\"/>\n<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"40\"/>\n"
                              "<Geometry GeometryType=\"XY\"><DataItem ItemType=\"HyperSlab\" Dimensions=\"40 2\">"
                              "<DataItem Dimensions=\"3 3\" Format=\"XML\">0 0 0 1 1 1 1 40 2</DataItem>"
                              "<DataItem NumberType=\"Float\" Precision=\"8\" Dimensions=\"3 40 2\" Format=\"HDF\">"
                              "trajectory.h5:/particles/disks/position/value</DataItem></DataItem></Geometry>"));
  EXPECT_THAT(text, HasSubstr("<Attribute Name=\"id\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem "
                              "ItemType=\"HyperSlab\" Dimensions=\"40\"><DataItem Dimensions=\"3 2\" Format=\"XML\">"
                              "2 0 1 1 1 40</DataItem><DataItem NumberType=\"UInt\" Precision=\"4\" "
                              "Dimensions=\"3 40\" Format=\"HDF\">trajectory.h5:/particles/disks/id/value</DataItem>"));
  EXPECT_THAT(text, HasSubstr("<Time Value=\"0.25\"/>"));
  EXPECT_THAT(text,
              HasSubstr("\"Float\" Precision=\"8\" Dimensions=\"40\" Format=\"HDF\">trajectory.h5:/particles/disks/"
                        "radius</DataItem>"));
}

TEST_F(Xdmf, OfSinglePrecisionAndThreeDimensions) {
  const std::string text = written({{0.0, 0.25}, 40, 4, 3, false});
  EXPECT_THAT(text, HasSubstr("GeometryType=\"XYZ\""));
  EXPECT_THAT(text, HasSubstr("1 0 0 1 1 1 1 40 3</DataItem><DataItem NumberType=\"Float\" Precision=\"4\" "
                              "Dimensions=\"2 40 3\" Format=\"HDF\">trajectory.h5:/particles/disks/velocity/value"));
  EXPECT_THAT(text, HasSubstr("Precision=\"8\" Dimensions=\"40\" Format=\"HDF\">trajectory.h5:/particles/disks/mass<"));
}

// In a region rows change their disks: radius and mass are those of the frame.
TEST_F(Xdmf, SizesOfARegionAreThoseOfTheFrame) {
  const std::string text = written({{0.0, 0.25}, 40, 8, 2, true});
  EXPECT_THAT(text, HasSubstr("<DataItem Dimensions=\"3 2\" Format=\"XML\">1 0 1 1 1 40</DataItem><DataItem "
                              "NumberType=\"Float\" Precision=\"8\" Dimensions=\"2 40\" Format=\"HDF\">"
                              "trajectory.h5:/particles/disks/radius/value</DataItem>"));
  EXPECT_THAT(text, Not(HasSubstr("disks/mass<")));
}

}  // namespace
}  // namespace carom
