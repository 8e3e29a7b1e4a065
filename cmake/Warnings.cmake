# Warnings are errors in our own code, but not where it is a part of another project, whose compiler may warn of more.
# Libraries from Debian come in as SYSTEM includes.
add_library(carom_warnings INTERFACE)
target_compile_options(carom_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wnull-dereference -Wdouble-promotion)
option(CAROM_WERROR "warnings are errors" ${PROJECT_IS_TOP_LEVEL})
if(CAROM_WERROR)
  target_compile_options(carom_warnings INTERFACE -Werror)
endif()
# g++ 12 reports null dereferences, overlaps and bounds inside the standard library's strings that are not there
# (std::string + at -O3, and more under sanitizers); the address sanitizer finds the real ones.
target_compile_options(carom_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference;-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow>)
# clang doubts | between comparisons; the hot loops mean it: without branches they become vector instructions.
target_compile_options(carom_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
# clang 19 warns of what std::stable_sort of g++ 12's library calls; g++ itself tells where we call what is deprecated.
target_compile_options(carom_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)
