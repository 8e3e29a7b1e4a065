// Which of a disk's neighbours it may meet: the kernel of the exact scan, in the versions that this machine may have.
#pragma once

#include <cstdint>

#include "core/exact_path.hpp"
#include "parallel/exact_flight.hpp"

namespace carom {

// The disk that looks, and what all its neighbours have in common.
struct ApproachFrame {
  double from = 0.0;          // time of the look
  double x = 0.0, y = 0.0;    // place then; length
  double vx = 0.0, vy = 0.0;  // length / time
  double gravity = 0.0;
  double width = 0.0, height = 0.0;            // periods; 0: none
  double half_width = 0.0, half_height = 0.0;  // infinite where there is no period
  double blur2 = 0.0;                          // square of what rounding may do to a place; length^2
  double own_reach = 0.0;                      // radius, with room for rounding
};

// Up to so many neighbours, in columns. Filled up to a whole number of four, with repetitions.
struct ApproachBatch {
  static constexpr std::uint32_t size = 32;
  const PathSegment* path[size];
  double reach[size];  // r1 + r2, with room for rounding
  double least[size];  // found: a contact comes no earlier than this after the look, if one comes
};

// Bit k is set if the disk and neighbour k approach, or do not clearly recede, on straight paths that come within
// reach: signs only, no square root and no division. Conservative; the exact formula decides. Never set for a path that
// is not a number.
using ApproachKernel = std::uint32_t (*)(const ApproachFrame& frame, ApproachBatch& batch, std::uint32_t count);

std::uint32_t approaching_baseline(const ApproachFrame& frame, ApproachBatch& batch, std::uint32_t count);
std::uint32_t approaching_avx2(const ApproachFrame& frame, ApproachBatch& batch, std::uint32_t count);

// The same for neighbours that are all seen on their own paths: flight[near[k]], k < count <= ApproachBatch::size. A
// contact with neighbour k comes no earlier than least[k] after the look; least has room for a multiple of four.
using FlightKernel = std::uint32_t (*)(const ApproachFrame& frame, const Flight* flight, const std::uint32_t* near,
                                       std::uint32_t count, double* least);

std::uint32_t approaching_flights_baseline(const ApproachFrame& frame, const Flight* flight, const std::uint32_t* near,
                                           std::uint32_t count, double* least);
std::uint32_t approaching_flights_avx2(const ApproachFrame& frame, const Flight* flight, const std::uint32_t* near,
                                       std::uint32_t count, double* least);

// The best version for the processor at hand.
ApproachKernel choose_approach_kernel();
FlightKernel choose_flight_kernel();

}  // namespace carom
