# Warnings are errors in our own code; libraries from Debian come in as SYSTEM includes.
add_library(carom_warnings INTERFACE)
target_compile_options(carom_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wnull-dereference -Wdouble-promotion -Werror)
# g++ 12 reports null dereferences and uninitialised reads inside the standard library under sanitizers and -O3.
target_compile_options(carom_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference>)
