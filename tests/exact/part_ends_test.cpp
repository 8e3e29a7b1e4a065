// The parts that a disk may come to before it is relisted: those whose rectangle is within reach, across periods, too.
#include "parallel/exact/part_ends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "parallel/exact/box_cut.hpp"

namespace carom {
namespace {

constexpr double side = 60.0;

AxisCut axis_of(std::size_t pieces, bool periodic) {
  AxisCut axis{periodic, side, {}};
  for (std::size_t k = 0; k <= pieces; ++k) {
    axis.line.push_back(side * static_cast<double>(k) / static_cast<double>(pieces));
  }
  return axis;
}

BoxCut cut_of(std::size_t x, std::size_t y, bool periodic) {
  return {axis_of(x, periodic), axis_of(y, periodic), 4.0};
}

// Is a point of the piece, or of its images, within reach of a coordinate?
bool is_near(const AxisCut& axis, std::size_t piece, double c, double reach) {
  for (const double turn : {-side, 0.0, side}) {
    if (turn != 0.0 && !axis.periodic) continue;
    if (c + turn + reach > axis.low(piece) && c + turn - reach < axis.high(piece)) return true;
  }
  return false;
}

std::uint8_t bits_within(const BoxCut& cut, std::size_t part, Vec2 at, double reach) {
  unsigned bits = 0;
  for (std::size_t other = 0; other < cut.parts(); ++other) {
    if (other == part || !is_near(cut.x, cut.column(other), at.x, reach) ||
        !is_near(cut.y, cut.row(other), at.y, reach)) {
      continue;
    }
    bits |= cut.ends_of(part).neighbours.bit_of(other);
  }
  return static_cast<std::uint8_t>(bits);
}

struct Noted {
  bool stays = false;
  OtherParts others;
};

// Notes a disk of radius 0.3, listed in the middle of its skin of 0.9.
Noted note(const BoxCut& cut, std::size_t part, Vec2 at, std::uint8_t known_to) {
  DiskRecord disk;
  disk.radius = 0.3;
  Noted noted;
  noted.others.known_to = known_to;
  noted.stays = cut.ends_of(part).note_listing(at, 0.9, disk, noted.others);
  return noted;
}

// Visits places in a part, and somewhat beyond its ends.
template <class Visit>
void for_places(const BoxCut& cut, std::size_t part, const Visit& visit) {
  const auto low = [](const AxisCut& axis, std::size_t piece) { return axis.low(piece) - 2.05; };
  for (double x = low(cut.x, cut.column(part)); x < cut.x.high(cut.column(part)) + 2.0; x += 0.37) {
    for (double y = low(cut.y, cut.row(part)); y < cut.y.high(cut.row(part)) + 2.0; y += 0.37) {
      const bool is_in_box = x >= 0.0 && x < side && y >= 0.0 && y < side;
      if (is_in_box) visit(Vec2{x, y});
    }
  }
}

TEST(PartEnds, NoteEachPartThatADiskMayReach) {
  for (const bool periodic : {false, true}) {
    for (const PieceCounts pieces : {PieceCounts{3, 3}, {2, 3}, {3, 2}, {1, 4}, {4, 1}}) {
      const BoxCut cut = cut_of(pieces.x, pieces.y, periodic);
      for (std::size_t part = 0; part < cut.parts(); ++part) {
        for_places(cut, part, [&](Vec2 at) {
          const std::uint8_t expected = bits_within(cut, part, at, 1.2);
          const Noted noted = note(cut, part, at, 0xff);
          EXPECT_TRUE(noted.stays);
          ASSERT_EQ(noted.others.may_reach, expected)
              << pieces.x << " by " << pieces.y << ", part " << part << ", " << at.x << " " << at.y;
        });
      }
    }
  }
}

// The window is void if one of these parts does not have the disk as a ghost.
TEST(PartEnds, AskWhetherEachOfThemHasTheDisk) {
  const BoxCut cut = cut_of(3, 3, true);
  for_places(cut, 4, [&](Vec2 at) {
    const unsigned near = bits_within(cut, 4, at, 1.2);
    EXPECT_TRUE(note(cut, 4, at, static_cast<std::uint8_t>(near)).stays);
    for (unsigned left = near; left != 0; left &= left - 1) {
      const unsigned one = left & ~(left - 1);
      EXPECT_FALSE(note(cut, 4, at, static_cast<std::uint8_t>(~one)).stays) << at.x << " " << at.y;
    }
  });
}

// Of five by five parts, the one in the middle has no data of parts two pieces away.
TEST(PartEnds, AreLeftForGoodWhereAThirdPartBegins) {
  const BoxCut cut = cut_of(5, 5, true);
  for (const double beyond : {18.0, 30.0, 42.0}) {
    EXPECT_TRUE(note(cut, 12, {beyond, 30.0}, 0xff).stays);
    EXPECT_TRUE(note(cut, 12, {30.0, beyond}, 0xff).stays);
  }
  for (const double beyond : {13.0, 47.0}) {
    EXPECT_FALSE(note(cut, 12, {beyond, 30.0}, 0xff).stays);
    EXPECT_FALSE(note(cut, 12, {30.0, beyond}, 0xff).stays);
  }
}

// Third parts begin where the neighbouring pieces end, for any widths.
TEST(PartEnds, AreLeftForGoodBehindPiecesOfAnyWidth) {
  AxisCut axis{true, side, {0.0, 10.0, 24.0, 30.0, 50.0, side}};
  const PartEnds ends = BoxCut{axis, axis_of(1, true), 4.0}.ends_of(2);  // the piece from 24 to 30
  DiskRecord disk;
  disk.radius = 0.3;
  OtherParts others{0xff, 0};
  for (const double at : {11.3, 30.0, 48.7}) EXPECT_TRUE(ends.note_listing({at, 5.0}, 0.9, disk, others)) << at;
  for (const double at : {11.1, 48.9}) EXPECT_FALSE(ends.note_listing({at, 5.0}, 0.9, disk, others)) << at;
}

// A disk that is relisted elsewhere may have met a disk where it was before.
TEST(PartEnds, KeepInMindWhereADiskMayHaveBeen) {
  const PartEnds ends = cut_of(3, 3, true).ends_of(4);
  DiskRecord disk;
  disk.radius = 0.3;
  OtherParts others{0xff, 0};
  ends.note_listing({20.5, 30.0}, 0.9, disk, others);
  ends.note_listing({30.0, 39.5}, 0.9, disk, others);
  ends.note_listing({30.0, 30.0}, 0.9, disk, others);
  EXPECT_EQ(others.may_reach, ends.neighbours.bit_of(3) | ends.neighbours.bit_of(7));
}

// A ghost is checked by its owner, so nothing is noted here.
TEST(PartEnds, LeaveGhostsAlone) {
  DiskRecord ghost;
  ghost.progress.set(DiskProgress::ghost);
  OtherParts others;
  EXPECT_TRUE(cut_of(3, 3, true).ends_of(4).note_listing({1.0, 1.0}, 0.9, ghost, others));
  EXPECT_EQ(others.may_reach, 0U);
}

TEST(PartEnds, TellHowFarBeyondThemAPlaceIs) {
  const PartEnds ends = cut_of(3, 1, true).ends_of(0);  // the piece from 0 to 20, in a periodic box
  EXPECT_DOUBLE_EQ(ends.x.beyond(23.0), 3.0);
  EXPECT_DOUBLE_EQ(ends.x.beyond(57.0), 3.0);
  EXPECT_DOUBLE_EQ(ends.x.beyond(15.0), -5.0);
  EXPECT_EQ(ends.y.beyond(15.0), -HUGE_VAL);
}

}  // namespace
}  // namespace carom
