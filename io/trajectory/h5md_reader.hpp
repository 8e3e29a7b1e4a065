// Reading back what H5mdWriter wrote.
#pragma once

#include "core/base/types.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

class H5mdReader : public TrajectoryReader {
 public:
  // Opens a finished file, one being written, and one whose writer was killed. Throws InputError for anything else.
  // growing: a run is writing it, and read() looks again for new frames at the end.
  explicit H5mdReader(const std::string& path, bool growing = false);
  ~H5mdReader() override;

  // Numbers of single precision are converted to double. Throws InputError if the file is damaged.
  bool read(TrajectoryFrame& frame) override;
  bool skip() override;
  void follow(const std::string& path) override { path_ = path; }

  Count frames() const;

 private:
  struct File;
  bool has_more();

  std::string path_;
  bool growing_ = false;
  Count next_ = 0;  // frame
  std::unique_ptr<File> file_;
};

}  // namespace carom
