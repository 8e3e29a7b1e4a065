// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nothing calls.
#define CAROM_NEAR_WALLS near_walls_avx2
#include "parallel/stepping/near_walls.inl"
