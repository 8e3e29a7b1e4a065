#include "core/disks/state_hash.hpp"

#include <bit>

namespace carom {

namespace {

// Finaliser of splitmix64 (Steele, Lea, Flood 2014): every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

std::uint64_t sum_of_hashes(const Disks& d) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    std::uint64_t h = mix(d.id[i] + 0x9e3779b97f4a7c15ULL);
    h = mix(h ^ std::bit_cast<std::uint64_t>(d.x[i]));
    h = mix(h ^ std::bit_cast<std::uint64_t>(d.y[i]));
    h = mix(h ^ std::bit_cast<std::uint64_t>(d.vx[i]));
    h = mix(h ^ std::bit_cast<std::uint64_t>(d.vy[i]));
    if (d.spins()) h = mix(h ^ std::bit_cast<std::uint64_t>(d.spin[i]));
    sum += h;
  }
  return sum;
}

std::uint64_t state_hash(std::size_t disks, std::uint64_t sum) {
  return mix(disks + 0x9e3779b97f4a7c15ULL) + sum;
}

std::uint64_t state_hash(const Disks& d) {
  return state_hash(d.size(), sum_of_hashes(d));
}

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t k = 0; k < 16; ++k) text[15 - k] = "0123456789abcdef"[(hash >> (4 * k)) & 15U];
  return text;
}

}  // namespace carom
