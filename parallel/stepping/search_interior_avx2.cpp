// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nothing calls.
#define CAROM_INTERIOR search_interior_avx2
#include "parallel/stepping/search_interior.inl"
