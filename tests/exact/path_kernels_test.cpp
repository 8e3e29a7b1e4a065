// The kernels that begin and end the paths of a window: each version gives the same as the computation for a single
// disk.
#include "parallel/exact/path_kernels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/disks/domain.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

constexpr std::size_t disks = 23;  // not a multiple of any number of lanes

std::array<PathKernels, 2> all_kernels() {
  return {path_kernels_baseline(), choose_path_kernels()};
}

struct Columns {
  std::vector<double> x = std::vector<double>(disks, -1.0), y = x, vx = x, vy = x;
};

std::vector<DiskRecord> random_records(test::Draws& draw) {
  std::vector<DiskRecord> record(disks);
  for (std::size_t i = 0; i < disks; ++i) {
    DiskRecord& r = record[i];
    r.path = {draw.in(0.0, 1.0), draw.in(0.0, 3.0), draw.in(0.0, 2.0), draw.in(-2.0, 2.0), draw.in(-2.0, 2.0)};
    r.partner = i % 3 == 0 ? Partner::relist() : Partner::disk(static_cast<std::uint32_t>(i));
    r.version = 5;
    r.partner_version = 7;
    r.progress.set(DiskProgress::ghost);
  }
  return record;
}

void expect_equal(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " and " << b;
}

// Only a range of disks is processed; those before and after it must stay as they are.
TEST(PathKernels, BeginEachPathWhereItsDiskIs) {
  test::Draws draw(3);
  for (const PathKernels& kernel : all_kernels()) {
    for (const bool stay : {false, true}) {
      Columns c;
      std::vector<DiskId> id(disks);
      for (std::size_t i = 0; i < disks; ++i) {
        c.x[i] = draw.in(-1.0, 1.0), c.y[i] = draw.in(-1.0, 1.0);
        c.vx[i] = draw.in(-1.0, 1.0), c.vy[i] = draw.in(-1.0, 1.0);
        id[i] = static_cast<DiskId>(draw.bits());
      }
      const std::vector<DiskRecord> before = random_records(draw);
      std::vector<DiskRecord> record = before;
      std::vector<CalendarEntry> entry(disks, {3.5, 11, 12});
      const std::size_t first = 2, last = 21;
      kernel.begin({c.x.data(), c.y.data(), c.vx.data(), c.vy.data(), id.data(), 0.25, record.data(), entry.data(),
                    stay, 1.25, 0.125},
                   first, last);
      for (std::size_t i = 0; i < disks; ++i) {
        const bool begins = i >= first && i < last;
        const PathSegment& p = record[i].path;
        expect_equal(p.start, begins ? 0.0 : before[i].path.start);
        expect_equal(p.x, begins ? c.x[i] : before[i].path.x);
        expect_equal(p.y, begins ? c.y[i] : before[i].path.y);
        expect_equal(p.vx, begins ? c.vx[i] : before[i].path.vx);
        expect_equal(p.vy, begins ? c.vy[i] : before[i].path.vy);
        EXPECT_EQ(record[i].radius, begins ? 0.25 : 0.0);
        EXPECT_EQ(record[i].id, begins ? id[i] : before[i].id);
        EXPECT_EQ(record[i].version, begins ? 0 : 5);
        EXPECT_EQ(record[i].partner_version, begins ? 0 : 7);
        EXPECT_TRUE(record[i].progress.has(DiskProgress::ghost));
        EXPECT_EQ(record[i].partner.is_relist(), i % 3 == 0 && (stay || !begins));
        EXPECT_EQ(record[i].partner.is_none(), begins && !(stay && i % 3 == 0));
        EXPECT_EQ(entry[i].time, begins ? (3.5 - 1.25) - 0.125 : 3.5);
        EXPECT_EQ(entry[i].previous, 11U);
        EXPECT_EQ(entry[i].next, 12U);
      }
    }
  }
}

// Positions on a border, one of them -0, a path that begins at the end, and a disk that is gone.
TEST(PathKernels, EndEachPathInTheBox) {
  constexpr double gone = std::numeric_limits<double>::quiet_NaN();
  test::Draws draw(4);
  for (const bool periodic_x : {false, true}) {
    for (const bool periodic_y : {false, true}) {
      std::vector<DiskRecord> record = random_records(draw);
      record[4].path = {1.0, -0.0, -0.0, 1.0, -1.0};
      record[5].path = {0.0, 2.0, 1.0, 1.0, 1.0};
      record[6].path = {0.5, gone, gone, 1.0, 1.0};
      record[7].path = {1.0, 1.0, 1.0, HUGE_VAL, -HUGE_VAL};
      for (const PathKernels& kernel : all_kernels()) {
        Columns c;
        kernel.end({record.data(), 1.0, c.x.data(), c.y.data(), c.vx.data(), c.vy.data(), periodic_x ? 0.0 : -HUGE_VAL,
                    periodic_x ? 3.0 : HUGE_VAL, periodic_y ? 0.0 : -HUGE_VAL, periodic_y ? 2.0 : HUGE_VAL},
                   1, 22);
        for (std::size_t i = 1; i < 22; ++i) {
          const PathSegment& p = record[i].path;
          double x = p.x, y = p.y;
          if (p.start != 1.0) x += p.vx * (1.0 - p.start), y += p.vy * (1.0 - p.start);
          if (periodic_x && (x < 0.0 || x >= 3.0)) x = wrap(x, 3.0);
          if (periodic_y && (y < 0.0 || y >= 2.0)) y = wrap(y, 2.0);
          if (i == 6) {
            EXPECT_TRUE(std::isnan(c.x[i]) && std::isnan(c.y[i]));
          } else {
            expect_equal(c.x[i], x);
            expect_equal(c.y[i], y);
          }
          expect_equal(c.vx[i], p.vx);
          expect_equal(c.vy[i], p.vy);
        }
        EXPECT_EQ(c.x[0], -1.0);
        EXPECT_EQ(c.x[22], -1.0);
      }
    }
  }
}

}  // namespace
}  // namespace carom
