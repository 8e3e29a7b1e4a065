# The only place for floating-point settings. Bits must not depend on compiler, optimisation level or machine:
#   -ffp-contract=off   no fused multiply-add where the source has a product and a sum
#   -fno-fast-math      stated explicitly, in case CXXFLAGS say otherwise
#   -fno-math-errno     allows sqrt to be one instruction; errno is not read anywhere, and results are the same
#   -fno-tree-loop-distribution  for g++: version 12.2 with -O3 splits a loop that stores the members of a struct and
#                       then copies it in the wrong place, so that the old contents are copied: frames of the reference
#                       had disks at 0 in scenes with thermal sides. Where the compiler is right no bit depends on it.
add_library(carom_determinism INTERFACE)
target_compile_options(carom_determinism INTERFACE -ffp-contract=off -fno-fast-math -fno-math-errno
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-loop-distribution>)
# In another project without a build type hot loops are still compiled for speed.
if(NOT PROJECT_IS_TOP_LEVEL)
  target_compile_options(carom_determinism INTERFACE $<$<CONFIG:>:-O3>)
endif()
