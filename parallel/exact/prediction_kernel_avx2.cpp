// Compiled with -mavx2 on x86-64 (CMakeLists.txt); on other machines it is a second copy of the baseline, which is not
// called.
#define CAROM_PREDICTION_KERNELS prediction_kernels_avx2
#include "parallel/exact/prediction_kernel.inl"
