# The one place for floating-point settings. Bits must not depend on compiler, optimisation level or machine:
#   -ffp-contract=off   no fused multiply-add where the source writes a product and a sum
#   -fno-fast-math      said aloud, should CXXFLAGS say otherwise
#   -fno-math-errno     lets sqrt be one instruction; errno is not read anywhere, results are the same
#   -fno-tree-loop-distribution  for g++: at -O3 version 12.2 cuts a loop that stores the members of a struct and then
#                       copies it whole in the wrong place, so that it copies what was there before: the reference's
#                       frames had disks at 0 in scenes with thermal sides. No bit depends on it where it is right.
add_library(carom_determinism INTERFACE)
target_compile_options(carom_determinism INTERFACE -ffp-contract=off -fno-fast-math -fno-math-errno
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-loop-distribution>)
# As part of another project that names no build type, hot loops are compiled for speed all the same.
if(NOT PROJECT_IS_TOP_LEVEL)
  target_compile_options(carom_determinism INTERFACE $<$<CONFIG:>:-O3>)
endif()
