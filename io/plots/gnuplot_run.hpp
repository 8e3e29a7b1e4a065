// Running a gnuplot script in a scratch folder.
#pragma once

#include <string>
#include <vector>

namespace carom {

// In single quotes gnuplot takes everything literally but the quote itself, which is doubled: no escapes, no command
// substitution. Control characters become blanks, and what no SVG file may have is changed.
std::string gnuplot_quoted(const std::string& text);

// A picture that a script writes under `name` (set output) and where it shall go.
struct GnuplotPicture {
  std::string name;
  std::string path;
};

// Runs the script in a folder of its own beside the first picture, where `data` lies in the file "data", and then moves
// the pictures to their places, all or none. Returns false, and writes nothing, where gnuplot is not installed. Throws
// RunError if it fails or a picture cannot be written.
bool run_gnuplot(const std::string& script, const std::string& data, const std::vector<GnuplotPicture>& pictures);

}  // namespace carom
