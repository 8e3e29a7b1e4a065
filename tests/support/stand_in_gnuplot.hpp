// What a plot is drawn from: a program in the place of gnuplot keeps its script and its data.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/test_folder.hpp"

namespace carom::test {

// As long as it lives, `gnuplot` draws nothing.
class StandInGnuplot {
 public:
  using Block = std::vector<std::vector<double>>;  // rows of numbers

  StandInGnuplot() : folder_("gnuplot"), path_(std::getenv("PATH")) {
    const std::string at = folder_.path().string();
    const std::string program = folder_.write(
        "gnuplot", "#!/bin/sh\ncp script '" + at + "/kept_script'\ncp data '" + at +
                       "/kept_data'\nfor p in plot.svg chart.svg chart.png; do echo '</svg>' >$p; done\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("PATH", (at + ":" + path_).c_str(), 1);
  }
  StandInGnuplot(const StandInGnuplot&) = delete;
  StandInGnuplot& operator=(const StandInGnuplot&) = delete;
  ~StandInGnuplot() { setenv("PATH", path_.c_str(), 1); }

  std::string picture() const { return folder_.path() / "picture.svg"; }
  std::string folder() const { return folder_.path().string(); }
  std::string script() const { return text_of(folder_.path() / "kept_script"); }

  // Lines of the script that begin so, without that.
  std::vector<std::string> commands(const std::string& begin) const {
    std::vector<std::string> found;
    std::istringstream lines(script());
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(begin)) found.push_back(line.substr(begin.size()));
    }
    return found;
  }

  // Blocks of the data, which two empty lines end each.
  std::vector<Block> blocks() const {
    std::vector<Block> all;
    std::istringstream lines(text_of(folder_.path() / "kept_data"));
    Block block;
    for (std::string line; std::getline(lines, line);) {
      if (line.empty()) {
        std::getline(lines, line);
        all.push_back(block);
        block.clear();
        continue;
      }
      std::vector<double>& row = block.emplace_back();
      std::istringstream words(line);
      for (std::string word; words >> word;) row.push_back(std::strtod(word.c_str(), nullptr));
    }
    return all;
  }

 private:
  TestFolder folder_;
  std::string path_;
};

}  // namespace carom::test
