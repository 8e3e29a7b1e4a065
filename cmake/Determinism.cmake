# The one place for floating-point settings. Bits must not depend on compiler, optimisation level or machine:
#   -ffp-contract=off   no fused multiply-add where the source writes a product and a sum
#   -fno-fast-math      said aloud, should CXXFLAGS say otherwise
#   -fno-math-errno     lets sqrt be one instruction; errno is not read anywhere, results are the same
add_library(carom_determinism INTERFACE)
target_compile_options(carom_determinism INTERFACE -ffp-contract=off -fno-fast-math -fno-math-errno)
# As part of another project that names no build type, hot loops are compiled for speed all the same.
if(NOT PROJECT_IS_TOP_LEVEL)
  target_compile_options(carom_determinism INTERFACE $<$<CONFIG:>:-O3>)
endif()
