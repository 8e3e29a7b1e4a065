// checkpoint_fields.hpp names the members of each struct twice: in a structured binding, which compiles only with all
// of them, and in the list that is written and read. A member missing in the second list would be lost in every resumed
// run, and no comparison of checkpoints would show it.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>

namespace carom {
namespace {

std::string without_spaces(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s"), "");
}

TEST(CheckpointFields, WritesAllThatItTakesApart) {
  std::ifstream file(CAROM_SOURCE_DIR "/io/checkpoint/checkpoint_fields.hpp");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string source = text.str();
  const std::regex lists(R"(Is<([\w:]+)> T>[^\[]*\[([^\]]*)\]\s*=\s*value;\s*stream\(([^)]*)\);)");
  std::size_t structs = 0;
  for (auto found = std::sregex_iterator(source.begin(), source.end(), lists); found != std::sregex_iterator();
       ++found, ++structs) {
    EXPECT_EQ(without_spaces((*found)[3]), without_spaces((*found)[2])) << (*found)[1];
  }
  const std::regex heads("template <class Stream, Is<");
  const auto all = std::distance(std::sregex_iterator(source.begin(), source.end(), heads), std::sregex_iterator());
  EXPECT_EQ(structs, static_cast<std::size_t>(all)) << "some functions have another form";
  EXPECT_GT(structs, 30U);
}

}  // namespace
}  // namespace carom
