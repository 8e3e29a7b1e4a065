// Measures the figures for which a speed is promised, prints them as a table and writes them, with a description of the
// machine, into a folder; the rows of parts that are not measured stay as they are.
//   carom_figures FOLDER [gas|scaling|special|features|exact|exact_growth|borders|memory]...   all, if none is named
#include "bench/figures/figures.hpp"

#include <fmt/format.h>
#include <fmt/os.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

#include "bench/support/figure_words.hpp"
#include "bench/support/shield.hpp"
#include "core/base/check.hpp"

namespace carom::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string promise(const Figure& f) {
  if (f.at_most) return fmt::format("at most {:g}", *f.at_most);
  if (f.at_least) return fmt::format("at least {:g}", *f.at_least);
  return "";
}

const char* verdict(const Figure& f) {
  if (!f.at_most && !f.at_least) return "";
  const bool kept = (!f.at_most || f.value <= *f.at_most) && (!f.at_least || f.value >= *f.at_least);
  return kept ? "kept" : "MISSED";
}

const char* commit() {
  const char* const given = std::getenv("CAROM_COMMIT");
  return given != nullptr ? given : "";
}

std::string quoted(const std::string& name) {
  return '"' + name + '"';
}

// The rows of figures that are not measured this time.
std::vector<std::string> other_rows(const std::string& file, const std::vector<Figure>& figures) {
  std::vector<std::string> rows;
  std::ifstream before(file);
  std::string row;
  std::getline(before, row);  // names of the columns
  while (std::getline(before, row)) {
    const auto is_row_of = [&](const Figure& f) { return row.starts_with(quoted(f.name) + ','); };
    if (std::none_of(figures.begin(), figures.end(), is_row_of)) rows.push_back(row);
  }
  return rows;
}

void write_figures(const std::string& folder, const std::vector<Figure>& figures) {
  const std::string name = folder + "/figures.csv";
  const std::vector<std::string> kept = other_rows(name, figures);
  auto file = fmt::output_file(name);
  file.print("figure,value,unit,promise,verdict,commit\n");
  for (const std::string& row : kept) file.print("{}\n", row);
  for (const Figure& f : figures) {
    file.print("{},{:.4g},{},{},{},{}\n", quoted(f.name), f.value, f.unit, promise(f), verdict(f), commit());
    fmt::print("{:<62} {:>8.3g} {:<15} {:<13} {}\n", f.name, f.value, f.unit, promise(f), verdict(f));
  }
}

void write_machine(const std::string& folder) {
  auto file = fmt::output_file(folder + "/machine.csv");
  file.print("what,value\nprocessor,{}\ncores,{}\ncompiler,{}\ncommit,{}\nshielded,{}\n", processor(),
             sysconf(_SC_NPROCESSORS_ONLN), CAROM_COMPILER, commit(), Shield::wanted() ? "yes" : "no");
}

int run(const FigureWords& words) {
  const std::string& folder = words.folder;
  std::filesystem::create_directories(folder);  // fails now, before minutes of measuring
  std::vector<Figure> all;
  const auto add = [&](std::vector<Figure> figures) { all.insert(all.end(), figures.begin(), figures.end()); };
  if (words.wants("memory")) add(measure_memory(CAROM_PROGRAM, CAROM_SOURCE_DIR "/scenes/gas_million.toml"));
  if (words.wants("gas")) add(measure_gas(folder));
  if (words.wants("scaling")) add(measure_scaling(folder));
  if (words.wants("special")) add(measure_special());
  if (words.wants("features")) add(measure_features(folder));
  if (words.wants("exact")) add(measure_exact(folder));
  if (words.wants("exact_growth")) add(measure_exact_growth(folder));
  if (words.wants("borders")) add(measure_borders(folder));
  write_figures(folder, all);
  write_machine(folder);
  return 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const std::string usage =
      fmt::format("usage: carom_figures FOLDER [{}]...\n", fmt::join(carom::bench::figure_parts, "|"));
  if (words.size() == 1 && (words[0] == "-h" || words[0] == "--help")) {
    fmt::print("{}", usage);
    return 0;
  }
  try {
    return carom::bench::run(carom::bench::figure_words(words));
  } catch (const carom::InputError& error) {
    fmt::print(stderr, "carom_figures: {}\n{}", error.what(), usage);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "carom_figures: {}\n", error.what());
    return 1;
  }
}
