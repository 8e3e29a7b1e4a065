#include "core/base/kernel_set.hpp"

#include <cstdlib>
#include <string_view>

#include "core/base/input_message.hpp"

namespace carom {

KernelSet choose_kernel_set(const char* wanted) {
  const std::string_view name = wanted == nullptr ? "" : wanted;
  if (name == "baseline") return KernelSet::baseline;
  if (!name.empty())
    fail_input("CAROM_KERNELS", "there are no kernels " + in_quotes(name), "expected baseline, or no value");
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return KernelSet::avx2;
#endif
  return KernelSet::baseline;
}

KernelSet kernel_set() {
  static const KernelSet chosen = choose_kernel_set(std::getenv("CAROM_KERNELS"));
  return chosen;
}

}  // namespace carom
