# Warnings are errors in this project's code, but not if it is part of another project, whose compiler may warn of more.
# Libraries from Debian are SYSTEM includes.
add_library(carom_warnings INTERFACE)
target_compile_options(carom_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wnull-dereference -Wdouble-promotion)
option(CAROM_WERROR "warnings are errors" ${PROJECT_IS_TOP_LEVEL})
if(CAROM_WERROR)
  target_compile_options(carom_warnings INTERFACE -Werror)
endif()
# g++ 12 reports null dereferences, overlaps and bounds within the standard library's strings that do not exist
# (std::string + with -O3, and more with sanitizers); real ones are found by the address sanitizer.
target_compile_options(carom_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference;-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow>)
# clang warns of | between comparisons; in the hot loops it is intended: without branches they become vector
# instructions.
target_compile_options(carom_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
# clang 19 warns of calls within std::stable_sort of g++ 12's library; g++ itself reports deprecated calls in this
# project.
target_compile_options(carom_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)
