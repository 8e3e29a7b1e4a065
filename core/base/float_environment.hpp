// How the processor rounds and whether it keeps denormal numbers. Both decide the bits of a run, and a host program may
// have changed both (libraries built with -ffast-math set flush-to-zero when they are loaded).
#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>

#include <cstdint>
#else
#include <cfenv>
#endif

namespace carom {

// While an object of this class lives, its thread rounds to nearest, keeps denormal numbers and traps nothing; its
// destructor restores the modes, but not the flags of exceptions that have occurred. One stands at each entry of the
// library and around every block of work that another thread runs. On x86 it also sets the x87 unit, whose mode the C
// library uses when it converts numbers from text.
class FloatEnvironment {
 public:
  FloatEnvironment();
  ~FloatEnvironment();
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

#ifdef __SSE2__
 private:
  unsigned before_ = _mm_getcsr();
  std::uint16_t x87_before_;
};

// Bits 0 to 5 tell of exceptions that have occurred, which change no result.
inline constexpr unsigned float_control = ~0x3fU, usual_float_control = 0x1f80U;
// Full precision, rounding to nearest, no traps.
inline constexpr std::uint16_t usual_x87_control = 0x037fU;

inline std::uint16_t x87_control() {
  std::uint16_t control = 0;
  __asm__ volatile("fnstcw %0" : "=m"(control));
  return control;
}

inline void set_x87_control(std::uint16_t control) {
  __asm__ volatile("fldcw %0" : : "m"(control));
}

// Writing the register costs more than reading it, and usually it has the right value already.
inline FloatEnvironment::FloatEnvironment() : x87_before_(x87_control()) {
  if ((before_ & float_control) != usual_float_control) _mm_setcsr(usual_float_control);
  if (x87_before_ != usual_x87_control) set_x87_control(usual_x87_control);
}

inline FloatEnvironment::~FloatEnvironment() {
  if ((before_ & float_control) != usual_float_control) _mm_setcsr(before_);
  if (x87_before_ != usual_x87_control) set_x87_control(x87_before_);
}
#else
 private:
  std::fenv_t before_{};
};

inline FloatEnvironment::FloatEnvironment() {
  std::fegetenv(&before_);
  std::fesetenv(FE_DFL_ENV);
}

inline FloatEnvironment::~FloatEnvironment() {
  std::fesetenv(&before_);
}
#endif

}  // namespace carom
