#include "io/plots/gnuplot_run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/check.hpp"
#include "io/files/child_process.hpp"
#include "io/files/output_file.hpp"
#include "io/files/scratch_folder.hpp"
#include "io/files/shown_text.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

// gnuplot does not report a full disk, but the picture then lacks its end.
bool is_whole(const std::string& picture) {
  return picture.find("</svg>") != std::string::npos || picture.find("IEND") != std::string::npos;
}

// Makes text valid in XML: gnuplot passes control characters and the end of CDATA through unchanged.
std::string text_of_xml(std::string text) {
  text = shown_text(text);
  for (std::size_t at = 0; (at = text.find("]]>", at)) != std::string::npos; at += 3) text.insert(at + 2, 1, ' ');
  return text;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text_of_xml(text)) {
    if (static_cast<unsigned char>(c) < ' ') {
      result += ' ';
    } else {
      result.append(c == '\'' ? 2U : 1U, c);
    }
  }
  return result + '\'';
}

bool run_gnuplot(const std::string& script, const std::string& data, const std::vector<GnuplotPicture>& pictures) {
  const std::string gnuplot = find_program("gnuplot");
  if (gnuplot.empty()) return false;
  // Beside the picture, where room is needed anyway.
  const ScratchFolder scratch(fs::path(pictures.front().path).parent_path(), "carom-plot");
  const std::string log = scratch.path() / "log";
  write_file(scratch.path() / "data", data);
  write_file(scratch.path() / "script", script);
  ChildProcess child({gnuplot, "--default-settings", "script"}, scratch.path(), log);
  const int status = child.wait();
  std::vector<std::string> contents;
  for (const GnuplotPicture& picture : pictures) {
    std::ostringstream bytes;
    bytes << std::ifstream(scratch.path() / picture.name, std::ios::binary).rdbuf();
    contents.push_back(bytes.str());
    if (status == 0 && is_whole(contents.back())) continue;
    const std::string said = last_line(log);
    throw RunError(fmt::format("gnuplot could not draw {}: {}", picture.path,
                               said.empty() ? "the picture is incomplete; is the disk full?" : said));
  }
  for (std::size_t k = 0; k < pictures.size(); ++k) write_file(pictures[k].path, contents[k]);
  return true;
}

}  // namespace carom
