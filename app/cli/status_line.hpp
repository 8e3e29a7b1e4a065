// A line of progress on standard error.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace carom {

// The output of the line, and its clock.
struct StatusPlace {
  bool terminal = false;
  std::size_t columns = 80;
  std::function<double()> seconds;  // any steady clock
  std::function<void(const std::string&)> write;
};
StatusPlace on_standard_error();

// On a terminal, one line that is updated in place, at most five times a second; elsewhere a new line each minute, the
// first after one minute.
class StatusLine {
 public:
  explicit StatusLine(bool wanted, StatusPlace place = on_standard_error());
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { clear(); }

  // Is it time for the next line? If so, the caller shows one.
  bool due() const;
  void show(const std::string& text);

  // Removes the line on a terminal, so that other text can be written; elsewhere does nothing.
  void clear();

  bool terminal() const { return place_.terminal; }
  double seconds() const { return place_.seconds(); }

 private:
  bool wanted_;
  bool on_screen_ = false;
  StatusPlace place_;
  double last_;
};

}  // namespace carom
