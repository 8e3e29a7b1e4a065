#include "tests/stability/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carom::stability {

namespace {

// "x0 47.98, is 48", or only the figure if it must be 0. Differences from the required value are given if they are too
// small to show.
std::string figure_text(const CheckResult& r) {
  if (r.expected == 0.0) return fmt::format("{} {:.2g}", r.what, r.measured);
  const double error = r.measured - r.expected;
  if (error == 0.0) return fmt::format("{} = {:g}", r.what, r.measured);
  if (std::abs(error) < 1e-3 * std::abs(r.expected)) return fmt::format("{} = {:g} {:+.1e}", r.what, r.expected, error);
  return fmt::format("{} {:.4g}, should be {:.4g}", r.what, r.measured, r.expected);
}

std::string in_csv_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2U : 1U, c);
  return quoted + "\"";
}

std::string joined(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "; "));
}

std::string markdown_table(const std::vector<CaseResult>& results) {
  std::string text = "| case | rollback | pairwise | exact |\n| --- | --- | --- | --- |\n";
  for (const CaseResult& result : results) {
    text += fmt::format("| [{}](../scenes/stability/{}.toml)", result.of->title, result.of->scene);
    for (const MethodResult& m : result.methods) {
      const char* const bold = m.verdict == Verdict::right ? "" : "**";
      text += fmt::format(" | {0}{1}{0}: {2}", bold, text_of(m.verdict), figure_text(m.telling()));
      if (m.right() && !m.warnings.empty()) text += "; warns";
    }
    text += " |\n";
  }
  return text;
}

constexpr const char* introduction = R"(# Stability

This page shows where each method fails, and that it reports the failure. Each case is a scene of
[scenes/stability/](../scenes/stability), run with all three methods. The expected figures and their bounds are in
[cases.toml](../scenes/stability/cases.toml) beside the scenes. F1 to F17 are the faults of the
[2014 program](original.md). Each verdict follows from numbers:

| verdict | meaning |
| --- | --- |
| *right* | every figure is within its bound, at t_end. Time stepping may have an error of its order in dt. "warns": the run was near its limits and warned of it |
| *right but slow* | right, with more than 20 times the work of the cheapest right method, if that is a tenth of a second or more; for rollback also if a dt takes more than two frames |
| *wrong and says so* | a warning, or status 3, with the figure and the remedy |
| *wrong in silence* | none of these; no case may be |

This page, stability.csv (every figure, bound and warning) and the maps are made by

    cmake --build --preset release --target carom_stability_docs

and `ctest -L stability` runs the same cases as tests. `./carom run SCENE --strict` ends a run with status 3 at its
first warning. [methods.md](methods.md) lists the warnings and their bounds.

![Error of the collision rate over packing fraction and dt](stability_dt.svg)

![Share of runs that collapse over number of disks and restitution](stability_collapse.svg)

)";

}  // namespace

std::string page(const std::vector<CaseResult>& results) {
  return introduction + fmt::format("{} cases, three methods: {}.\n\n", results.size(), counts_text(results)) +
         markdown_table(results);
}

std::string counts_text(const std::vector<CaseResult>& results) {
  std::array<int, 4> counts{};
  for (const CaseResult& result : results) {
    for (const MethodResult& m : result.methods) ++counts[static_cast<std::size_t>(m.verdict)];
  }
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    text += fmt::format("{}{} {}", k == 0 ? "" : ", ", counts[k], text_of(static_cast<Verdict>(k)));
  }
  return text;
}

std::string csv_table(const std::vector<CaseResult>& results) {
  std::string text = "case,scene,method,verdict,figure,measured,expected,bound,holds,work,hash,warnings\n";
  for (const CaseResult& result : results) {
    for (const MethodResult& m : result.methods) {
      for (std::size_t k = 0; k < m.checks.size(); ++k) {
        const CheckResult& c = m.checks[k];
        std::vector<std::string> said = m.warnings;
        if (!m.stopped.empty() && std::find(said.begin(), said.end(), m.stopped) == said.end())
          said.push_back(m.stopped);
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", result.of->name, result.of->scene, m.method,
                            text_of(m.verdict), c.what, c.measured, c.expected, c.bound, c.holds() ? "yes" : "no",
                            m.work, m.hash, k == 0 ? in_csv_quotes(joined(said)) : "");
      }
    }
  }
  return text;
}

}  // namespace carom::stability
