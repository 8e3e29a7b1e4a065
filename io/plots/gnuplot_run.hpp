// Running a gnuplot script in a scratch folder.
#pragma once

#include <string>
#include <vector>

namespace carom {

// Text in single quotes, in which gnuplot takes everything literally except the quote itself, which is doubled: there
// are no escapes and no command substitution. Control characters become blanks, and what is invalid in SVG is changed.
std::string gnuplot_quoted(const std::string& text);

// A picture that a script writes under `name` (set output), and its destination.
struct GnuplotPicture {
  std::string name;
  std::string path;
};

// Runs the script in a folder of its own beside the first picture, with `data` in the file "data", and then moves the
// pictures to their destinations, all or none. Returns false, and writes nothing, if gnuplot is not installed. Throws
// RunError if it fails or a picture cannot be written.
bool run_gnuplot(const std::string& script, const std::string& data, const std::vector<GnuplotPicture>& pictures);

}  // namespace carom
