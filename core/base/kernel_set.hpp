// The instruction set of the kernels that exist in several versions (*_baseline.cpp, *_avx2.cpp).
#pragma once

namespace carom {

enum class KernelSet { baseline, avx2 };

// The set for a value of CAROM_KERNELS: null or empty chooses the best that this processor supports, "baseline" the one
// that every processor supports. Throws InputError for any other value.
KernelSet choose_kernel_set(const char* wanted);

// The set of this process, from its environment, which is read once. All sets give the same bits. Throws as
// choose_kernel_set.
KernelSet kernel_set();

}  // namespace carom
