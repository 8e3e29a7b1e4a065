// The box cut into parts: each disk is one part's own, and halos are as wide as they say.
#include "parallel/exact/box_cut.hpp"

#include <gtest/gtest.h>

namespace carom {
namespace {

Disks spread(std::size_t count, double width, double height) {
  Disks d;
  d.common_radius = 0.1;
  for (std::size_t k = 0; k < count; ++k) {
    const double u = static_cast<double>((k * 7919) % count) / static_cast<double>(count);
    const double v = static_cast<double>((k * 104729) % count) / static_cast<double>(count);
    append(d, {u * width, v * v * height, 0.0, 0.0, 0.1, 1.0, static_cast<DiskId>(k), 0.0});
  }
  return d;
}

Domain box_of(double width, double height, SideKind ends) {
  Domain box;
  box.width = width;
  box.height = height;
  box.sides = {ends, ends, ends, ends};
  return box;
}

TEST(BoxCut, EachDiskIsOnePartsOwn) {
  const Disks d = spread(3001, 10.0, 40.0);
  for (const SideKind ends : {SideKind::periodic, SideKind::wall}) {
    const BoxCut cut = cut_box(d, box_of(10.0, 40.0, ends), 4, 1.5);
    ASSERT_EQ(cut.parts(), 4U);
    EXPECT_FALSE(cut.along_x);
    std::vector<std::size_t> own(4, 0);
    for (std::size_t k = 0; k < d.size(); ++k) {
      int owners = 0;
      for (std::size_t part = 0; part < 4; ++part) {
        if (!cut.owns(part, d.y[k])) continue;
        ++owners;
        ++own[part];
      }
      EXPECT_EQ(owners, 1);
    }
    // Spread unevenly, but each has about as many.
    for (const std::size_t count : own) EXPECT_NEAR(static_cast<double>(count), 3001.0 / 4.0, 20.0);
  }
}

TEST(BoxCut, HalosLieBehindTheEnds) {
  const Disks d = spread(3001, 40.0, 10.0);
  const BoxCut cut = cut_box(d, box_of(40.0, 10.0, SideKind::periodic), 2, 3.0);
  ASSERT_TRUE(cut.along_x);
  const double line = cut.high(0);
  EXPECT_TRUE(cut.in_halo(0, line + 2.9));
  EXPECT_FALSE(cut.in_halo(0, line + 3.1));
  EXPECT_TRUE(cut.in_halo(0, 37.1)) << "round the box";
  EXPECT_FALSE(cut.in_halo(0, 36.9));
  EXPECT_TRUE(cut.in_halo(1, 2.9));
  EXPECT_TRUE(cut.is_known_above(0, line - 2.9));
  EXPECT_FALSE(cut.is_known_above(0, line - 3.1));
  EXPECT_TRUE(cut.is_known_below(0, 2.9));
  EXPECT_FALSE(cut.is_known_below(0, line + 1.0)) << "not its own";
}

TEST(BoxCut, WallsHaveNoHalos) {
  const Disks d = spread(1000, 10.0, 40.0);
  const BoxCut cut = cut_box(d, box_of(10.0, 40.0, SideKind::wall), 2, 3.0);
  EXPECT_FALSE(cut.in_halo(0, 39.0));
  EXPECT_FALSE(cut.is_known_below(0, 1.0));
  // Rounding may lead a disk out.
  EXPECT_TRUE(cut.owns(0, -1e-12));
  EXPECT_TRUE(cut.owns(1, 40.0 + 1e-12));
}

TEST(BoxCut, PartsAreNotNarrowerThanHalos) {
  const Disks d = spread(1000, 10.0, 40.0);
  const BoxCut cut = cut_box(d, box_of(10.0, 40.0, SideKind::wall), 64, 6.0);
  EXPECT_LE(cut.parts(), 6U);
  for (std::size_t part = 0; part < cut.parts(); ++part) EXPECT_GE(cut.high(part) - cut.low(part), 6.0 - 1e-9);
}

}  // namespace
}  // namespace carom
