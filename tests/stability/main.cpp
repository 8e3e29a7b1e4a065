// carom_stability: runs the suite and writes the tables and pictures that docs/ shows.
//   carom_stability --table DIR    all cases: DIR/stability.md and stability.csv
//   carom_stability --maps DIR     DIR/stability_dt.svg, stability_collapse.svg and their numbers as .csv
//   carom_stability --case NAME    prints the cases whose names begin with NAME
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "io/files/output_file.hpp"
#include "tests/stability/case.hpp"
#include "tests/stability/map.hpp"
#include "tests/stability/table.hpp"
#include "tests/stability/verdict.hpp"

namespace carom::stability {
namespace {

void print(const CaseResult& result) {
  for (const MethodResult& m : result.methods) {
    fmt::print("{:<28} {:<9} {:<18} work {:.3g}\n", result.of->name, m.method, text_of(m.verdict), m.work);
    for (const CheckResult& c : m.checks) {
      fmt::print("    {:<14} {:<22.15g} expected {:<22.15g} bound {:<8.3g} {}\n", c.what, c.measured, c.expected,
                 c.bound, c.holds() ? "" : "BROKEN");
    }
    for (const std::string& w : m.warnings) fmt::print("    ! {}\n", w);
  }
  std::fflush(stdout);
}

const std::string folder = CAROM_SOURCE_DIR "/scenes/stability";

void show_case(const std::string& name) {
  for (const Case& c : read_cases(folder + "/cases.toml")) {
    if (c.name.starts_with(name)) print(run_case(c, folder, Which::parallel));
  }
}

void write_docs(const std::string& out) {
  std::vector<CaseResult> results;
  const std::vector<Case> cases = read_cases(folder + "/cases.toml");
  for (const Case& c : cases) {
    fmt::print(stderr, "{}\n", c.name);
    results.push_back(run_case(c, folder, Which::parallel));
  }
  write_file(out + "/stability.md", page(results));
  write_file(out + "/stability.csv", csv_table(results));
  fmt::print("{}\n", counts_text(results));
}

int run(const std::vector<std::string>& words) {
  if (words.size() != 2) throw InputError("expected --case NAME, --table DIR or --maps DIR");
  if (words[0] == "--case") {
    show_case(words[1]);
  } else if (words[0] == "--table") {
    write_docs(words[1]);
  } else if (words[0] == "--maps") {
    write_dt_map(words[1]);
    write_collapse_map(words[1]);
  } else {
    throw InputError("there is no option " + words[0] + "; expected --case, --table or --maps");
  }
  return 0;
}

}  // namespace
}  // namespace carom::stability

int main(int argc, char** argv) {
  try {
    return carom::stability::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "carom_stability: error: {}\n", error.what());
    return 1;
  }
}
