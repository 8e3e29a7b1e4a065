#include "parallel/kicks/kick_all.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/disks/disk_view.hpp"
#include "core/step/thermostat.hpp"
#include "parallel/kicks/draw_kernels.hpp"

namespace carom {

namespace {

// Disks whose deviates are drawn together: they stay in the first-level cache.
constexpr std::size_t batch = 256;

// The disks of a batch that a kick chooses.
struct Chosen {
  std::array<std::uint32_t, batch> disk;
  std::array<DiskId, batch> id;
  std::size_t count = 0;

  // Chooses all of disks [first, first + n).
  void take_all(const Disks& d, std::size_t first, std::size_t n) {
    count = n;
    for (std::size_t k = 0; k < n; ++k) {
      disk[k] = static_cast<std::uint32_t>(first + k);
      id[k] = d.id[first + k];
    }
  }

  // Keeps those whose number u is below the share, without a branch, which could not be predicted.
  void take_share(double share, const std::array<double, batch>& u) {
    const std::size_t n = count;
    count = 0;
    for (std::size_t k = 0; k < n; ++k) {
      disk[count] = disk[k];
      id[count] = id[k];
      count += u[k] < share ? 1U : 0U;
    }
  }
};

}  // namespace

void kick_range(Disks& disks, const Scene& scene, Count number, std::size_t begin, std::size_t end, ExactSum& heat,
                std::vector<std::uint32_t>* kicked) {
  const DrawKernels draw = choose_draw_kernels();
  const Kick kick = kick_of(scene);
  const double share = kicked_share(scene);
  Chosen chosen;
  std::array<double, batch> x, y, given;
  with_view(disks, [&](const auto& d) {
    for (std::size_t first = begin; first < end; first += batch) {
      chosen.take_all(disks, first, std::min(batch, end - first));
      if (share < 1.0) {
        draw.uniforms({x.data(), chosen.id.data(), scene.seed, Stream::thermostat_choice, number}, chosen.count);
        chosen.take_share(share, x);
      }
      draw.normals({x.data(), y.data(), chosen.id.data(), scene.seed, Stream::thermostat, number, 1.0, false}, 0,
                   chosen.count);
      for (std::size_t k = 0; k < chosen.count; ++k) given[k] = kick_disk(d, scene, kick, chosen.disk[k], {x[k], y[k]});
      heat.add(std::span<const double>(given).first(chosen.count));
      if (kicked != nullptr) kicked->insert(kicked->end(), chosen.disk.begin(), chosen.disk.begin() + chosen.count);
    }
  });
}

ExactSum kick_all(Disks& disks, const Scene& scene, Count number, const Executor& executor,
                  std::vector<std::uint32_t>* kicked) {
  const std::size_t n = disks.size();
  const std::size_t blocks = executor.blocks(n, kick_block);
  std::vector<ExactSum> heat(blocks + 1);
  std::vector<std::vector<std::uint32_t>> chosen(kicked != nullptr ? blocks : 0);
  executor.for_ranges(n, kick_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    kick_range(disks, scene, number, begin, end, heat[b], kicked != nullptr ? &chosen[b] : nullptr);
  });
  for (const std::vector<std::uint32_t>& c : chosen) kicked->insert(kicked->end(), c.begin(), c.end());
  for (std::size_t b = 1; b < heat.size(); ++b) heat[0].add(heat[b]);
  return heat[0];
}

bool kick_if_due(const Scene& scene, State& state, const Executor& executor, std::vector<std::uint32_t>* kicked) {
  if (!is_kick_due(scene, state)) return false;
  const Count number = state.intervals++;
  state.counters.thermostat_heat += kick_all(state.disks, scene, number, executor, kicked).value();
  return true;
}

}  // namespace carom
