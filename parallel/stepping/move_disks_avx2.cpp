// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nothing calls.
#define CAROM_MOVE_DISKS move_disks_avx2
#define CAROM_MOVE_SHEARED move_sheared_avx2
#include "parallel/stepping/move_disks.inl"
