// Reading back what H5mdWriter wrote.
#pragma once

#include "core/base/types.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

class H5mdReader : public TrajectoryReader {
 public:
  // Opens a finished file, one being written, and one whose writer was killed. Throws InputError for anything else.
  explicit H5mdReader(const std::string& path);
  ~H5mdReader() override;

  // Single precision comes widened. Throws InputError where the file is damaged.
  bool read(TrajectoryFrame& frame) override;

  Count frames() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace carom
