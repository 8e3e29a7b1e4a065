// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nobody calls.
#define CAROM_APPROACHING approaching_avx2
#define CAROM_APPROACHING_FLIGHTS approaching_flights_avx2
#include "parallel/approach.inl"
