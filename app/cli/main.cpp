// carom, in one process.
#include "app/cli/program.hpp"

int main(int argc, char** argv) {
  return carom::program(argc, argv, nullptr);
}
