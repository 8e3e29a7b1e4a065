#include "io/movie/disk_raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace carom {
namespace {

TEST(DiskRaster, AreaIsThatOfTheDisk) {
  for (const double r : {0.2, 0.5, 1.0, 2.5}) {
    std::array<std::uint32_t, 32 * 32> image{};
    fill_disk({image.data(), 32, 0, 0, 32, 32}, 15.3, 16.8, r, {200.0, 0.0, 0.0});
    double sum = 0.0;
    for (const std::uint32_t p : image) sum += static_cast<double>(p >> 16) / 200.0;
    EXPECT_NEAR(sum, M_PI * r * r, 0.1 * M_PI * r * r) << r;
  }
}

// In a mixture no radius must be a border beyond which disks look different.
TEST(DiskRaster, RimsComeGraduallyWithTheRadius) {
  const auto image_of = [](double r) {
    std::array<std::uint32_t, 32 * 32> image{};
    fill_disk({image.data(), 32, 0, 0, 32, 32}, 16.0, 16.0, r, {200.0, 0.0, 0.0});
    return image;
  };
  for (double r = 1.0; r < 10.0; r += 0.02) {
    const auto some = image_of(r), more = image_of(r + 0.02);
    for (std::size_t k = 0; k < some.size(); ++k) {
      EXPECT_NEAR(static_cast<double>(some[k] >> 16), static_cast<double>(more[k] >> 16), 8.0) << r;
    }
  }
  EXPECT_EQ(rim_shade(2.9), 1.0);
  EXPECT_NEAR(rim_shade(6.0), 0.35, 1e-12);
}

// Each pixel has the colour given by the shares of it that the disk and its inner part cover.
TEST(DiskRaster, PixelsAreThoseOfTheFormula) {
  constexpr int side = 48;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int k = 0; k < 400; ++k) {
    std::vector<std::uint32_t> image(side * side, 0x4080c0U);
    const PixelArea area{image.data(), side, 5, 3, side - 7, side - 2};
    const double x = side * uniform(random), y = side * uniform(random), r = 0.7 + 20.0 * std::pow(uniform(random), 2);
    const Colour colour{255.0 * uniform(random), 255.0 * uniform(random), 255.0 * uniform(random)};
    fill_disk(area, x, y, r, colour);
    for (int row = area.top; row < area.bottom; ++row) {
      for (int column = area.left; column < area.right; ++column) {
        const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
        const double share = std::clamp(r + 0.5 - distance, 0.0, 1.0);
        const double inside = std::clamp(r - rim_width + 0.5 - distance, 0.0, 1.0);
        const double shade = inside + (1.0 - inside) * rim_shade(r);
        const auto mixed = [&](double old, double full) {
          return static_cast<int>(std::lround(old + share * (full * shade - old)));
        };
        const std::uint32_t p = image[static_cast<std::size_t>(side * row + column)];
        EXPECT_EQ(static_cast<int>(p >> 16), mixed(0x40, colour.red)) << x << ' ' << y << ' ' << r;
        EXPECT_EQ(static_cast<int>(p >> 8 & 0xffU), mixed(0x80, colour.green)) << x << ' ' << y << ' ' << r;
        EXPECT_EQ(static_cast<int>(p & 0xffU), mixed(0xc0, colour.blue)) << x << ' ' << y << ' ' << r;
      }
    }
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const bool within = row >= area.top && row < area.bottom && column >= area.left && column < area.right;
        if (within) continue;
        EXPECT_EQ(image[static_cast<std::size_t>(side * row + column)], 0x4080c0U);
      }
    }
  }
}

// A disk smaller than a pixel is visible in the corners of the area, too.
TEST(DiskRaster, TheAreaIsFilledToItsEdges) {
  for (const int column : {4, 11}) {
    for (const int row : {4, 11}) {
      std::array<std::uint32_t, 16 * 16> image{};
      fill_disk({image.data(), 16, 4, 4, 12, 12}, column + 0.5, row + 0.5, 0.4, {255.0, 255.0, 255.0});
      EXPECT_NE(image[static_cast<std::size_t>(16 * row + column)], 0U) << column << " " << row;
    }
  }
}

TEST(DiskRaster, NothingOutsideTheArea) {
  std::array<std::uint32_t, 16 * 16> image{};
  for (const double x : {-3.0, 4.0, 8.0, 11.9, 20.0}) {
    fill_disk({image.data(), 16, 4, 4, 12, 12}, x, 6.0, 3.0, {255.0, 255.0, 255.0});
    fill_disk({image.data(), 16, 4, 4, 12, 12}, x, 12.0, 0.4, {255.0, 255.0, 255.0});
  }
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      if (row >= 4 && row < 12 && column >= 4 && column < 12) continue;
      EXPECT_EQ(image[static_cast<std::size_t>(16 * row + column)], 0U);
    }
  }
}

}  // namespace
}  // namespace carom
