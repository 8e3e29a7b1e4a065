// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline, and is not called.
#define CAROM_PREDICTION_KERNELS prediction_kernels_avx2
#include "parallel/exact/prediction_kernel.inl"
