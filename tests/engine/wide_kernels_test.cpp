// The object files of kernels for a wider instruction set (*_avx2.cpp) contain no function that other files may be
// linked with.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <string>

namespace {

// An inline function or a template that a compiler does not inline goes into every object file that calls it, and the
// linker keeps any one of them: a machine without AVX2 might get the one with AVX2 instructions.
TEST(WideKernels, LeaveNoInlineFunctionToTheLinker) {
  const std::string objects = CAROM_WIDE_KERNELS;
  if (objects.empty()) GTEST_SKIP() << "without optimisation nothing is inlined; such builds stay where they are made";
  FILE* const symbols = popen(("nm -C --defined-only " + objects).c_str(), "r");
  ASSERT_NE(symbols, nullptr);
  int lines = 0;
  char line[4000];
  while (std::fgets(line, sizeof line, symbols) != nullptr) {
    ++lines;
    EXPECT_EQ(std::strstr(line, " W "), nullptr) << line;
  }
  EXPECT_EQ(pclose(symbols), 0);
  EXPECT_GT(lines, 5);
}

}  // namespace
