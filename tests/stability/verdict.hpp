// Running a case with one method, and the verdict, which follows from the case's data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/stability/case.hpp"

namespace carom::stability {

enum class Verdict : std::uint8_t { right, slow, says_so, silent };
std::string_view text_of(Verdict verdict);

struct CheckResult {
  std::string what;
  double measured = 0.0, expected = 0.0, bound = 0.0;
  bool holds() const;
  double over_bound() const;  // error over bound; infinite if the bound is 0 and exceeded
};

struct MethodResult {
  std::string method;
  Verdict verdict = Verdict::silent;
  std::vector<CheckResult> checks;
  std::vector<std::string> warnings;
  std::string stopped;                 // the reason why the run ended early; empty if it did not
  double work = 0.0;                   // disk-steps; an event of the exact method counts by its cost
  double frames = 0.0;                 // rollback: frames for each dt of time
  std::string hash;                    // of the last state
  const CheckResult& telling() const;  // the check that is worst relative to its bound
  bool right() const;
};

// A run is slow if it is right, but costs more than this many times the cheapest right method.
inline constexpr double slow_factor = 20.0;
// Runs of fewer disk-steps than this, a tenth of a second, are never called slow.
inline constexpr double little_work = 3e6;
// Nor is rollback called slow for up to two frames in a dt if there is hardly anything to do.
inline constexpr double most_frames = 2.0;
inline constexpr double least_work = 1e5;

struct CaseResult {
  const Case* of = nullptr;
  std::vector<MethodResult> methods;  // rollback, pairwise, exact
};

enum class Which : std::uint8_t { parallel, reference };

// Runs the case with every method. folder: that of its scene.
CaseResult run_case(const Case& c, const std::string& folder, Which which);

}  // namespace carom::stability
