// Which instruction set the kernels with more than one version (*_baseline.cpp, *_avx2.cpp) run in.
#pragma once

namespace carom {

enum class KernelSet { baseline, avx2 };

// The one for a value of CAROM_KERNELS: null or empty takes the best that this processor has, "baseline" the one that
// every processor has. Throws InputError for any other value.
KernelSet choose_kernel_set(const char* wanted);

// The one of this process, from its environment, read once. All give the same bits. Throws as choose_kernel_set.
KernelSet kernel_set();

}  // namespace carom
