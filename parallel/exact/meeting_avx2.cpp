// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nobody calls.
#define CAROM_MEETING_KERNELS meeting_kernels_avx2
#include "parallel/exact/meeting.inl"
