#define CAROM_APPROACHING approaching_baseline
#define CAROM_APPROACHING_FLIGHTS approaching_flights_baseline
#include "parallel/approach.inl"

namespace carom {

ApproachKernel choose_approach_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return approaching_avx2;
#endif
  return approaching_baseline;
}

FlightKernel choose_flight_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return approaching_flights_avx2;
#endif
  return approaching_flights_baseline;
}

}  // namespace carom
