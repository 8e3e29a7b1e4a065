// Only regular files are read, which have an end: no devices, and no FIFOs, where reading would wait for a writer.
#include "core/base/input_file.hpp"

#include <sys/stat.h>

#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using testing::HasSubstr;

class InputFile : public test::CommandTest {
 protected:
  InputFile() { EXPECT_EQ(mkfifo(at("fifo").c_str(), 0600), 0); }
};

TEST_F(InputFile, SceneMustEnd) {
  expect_error("$C run /dev/zero", 2, "/dev/zero: is a device, which may never end; expected a regular file");
  expect_error("$C run fifo", 2, "fifo: is a FIFO, which may never end; expected a regular file");
  expect_error("$C check /dev/zero", 2, "/dev/zero: is a device");
  expect_error("$C sweep fifo --seeds 2", 2, "fifo: is a FIFO");
  expect_error("$C run /tmp", 2, "/tmp: is a directory; expected a scene file");
}

TEST_F(InputFile, FilesOfASceneMustEnd) {
  for (const std::string file : {"/dev/zero", "fifo"}) {
    expect_error("$C check small.toml --set 'disks.0.positions={ file = \"" + file + "\" }'", 2,
                 "disks.0.positions.file \"" + file + "\": is a ");
    expect_error("$C check small.toml --set 'disks.0.positions={ frame = \"" + file + "\" }'", 2,
                 "disks.0.positions.frame: ");
  }
}

TEST_F(InputFile, TrajectoriesAndCheckpointsMustEnd) {
  for (const std::string file : {"/dev/zero", "fifo"}) {
    expect_error("$C render " + file + " -o movie.mp4", 2, file + ": is a ");
    expect_error("$C compare " + file + " " + file, 2, file + ": is a ");
    expect_error("$C resume " + file, 2, file + ": is a ");
  }
}

TEST_F(InputFile, StandardInputIsRead) {
  EXPECT_EQ(shell("cat small.toml | $C check /dev/stdin").status, 0);
  EXPECT_EQ(shell("{ sleep 0.1; cat small.toml; } | $C check /dev/fd/0").status, 0) << "it must wait for a slow writer";
  EXPECT_EQ(shell("$C check /dev/stdin <small.toml").status, 0);
}

// Other processes, such as runs and ranks, cannot read files that only this process has open. They must find nothing
// there, and not wait.
TEST_F(InputFile, WhatSeveralProcessesReadHasAName) {
  const std::string expected = "/dev/stdin: cannot be read by several processes; expected the name of a file";
  expect_error("$C sweep /dev/stdin -o s --seeds 2 <small.toml", 2, expected);
  expect_error("cat small.toml | $C sweep /dev/fd/0 -o s --seeds 2 --emit parallel", 2,
               "/dev/fd/0: cannot be read by several");
  expect_error("$C run /dev/stdin --ranks 2 <small.toml", 2, expected);
  EXPECT_FALSE(std::filesystem::exists(at("s")));
  write("places.csv", "1,1\n3,3\n5,5\n7,7\n9,9\n");
  const test::Outcome o =
      shell("$C sweep small.toml -o s --seeds 2 --set 'disks.0.positions={ file = \"/dev/stdin\" }' <places.csv");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.err, HasSubstr("run 0001: --set disks.0.positions"));
}

}  // namespace
}  // namespace carom
