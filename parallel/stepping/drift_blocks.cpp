#include "parallel/stepping/drift_blocks.hpp"

#include <algorithm>
#include <cstddef>

#include "core/physics/contact_of_step.hpp"
#include "parallel/stepping/move_kernel.hpp"
#include "parallel/stepping/near_walls.hpp"
#include "parallel/stepping/wall_reach.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// Disks in a block: four columns of it fit into the second-level cache.
constexpr std::size_t drift_block = 8192;

// Runs the kernel on all disks, level by level. Returns the largest squared speed.
double move_all(MoveInput in, std::size_t disks, const Executor& executor, CellList& cells) {
  CoarsePositions& coarse = cells.coarse;
  const MoveKernel kernel = choose_move_kernels().in_levels;
  in.key = cells.sorted.key.data();
  in.position = coarse.position.data();
  double speed2 = 0.0;
  coarse.blocks = 0;
  for (const GridLevel& level : cells.grid.levels) {
    const LevelRange range = range_of(level, cells.sorted);
    const std::size_t n = range.last - range.first;
    const std::size_t before = coarse.blocks;
    coarse.blocks += executor.blocks(n, drift_block);
    while (coarse.strays.size() < coarse.blocks) {
      coarse.strays.emplace_back();
      coarse.strays.back().reserve(drift_block / 64);
    }
    assign_amply(coarse.speed2, executor.blocks(n, drift_block), 0.0);
    executor.for_ranges(n, drift_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& strays = coarse.strays[before + b];
      strays.clear();
      coarse.speed2[b] = kernel(in, level, range.first + begin, range.first + end, strays);
    });
    for (const double v2 : coarse.speed2) speed2 = std::max(speed2, v2);
  }
  // Loose disks stored after the last cell. Each loose disk is searched for by itself, whether it strays or not.
  const std::size_t sorted = cells.sorted.start.back();
  if (sorted < disks) [[unlikely]] {
    std::vector<std::uint32_t> unread;
    speed2 = std::max(speed2, kernel(in, cells.grid.levels.front(), sorted, disks, unread));
  }
  coarse.current = true;
  return speed2;
}

}  // namespace

double drift_blocks(Disks& d, const Domain& box, const Gravity& gravity, double t, const Executor& executor,
                    CellList& cells) {
  const Motion motion = gravity.is_tilted() ? Motion::tilted_parabola
                        : gravity.acts()    ? Motion::parabola
                                            : Motion::straight;
  return move_all({d.x.data(), d.y.data(), d.vx.data(), d.vy.data(), nullptr, nullptr, box, motion, t, gravity},
                  d.size(), executor, cells);
}

void note_coarse_positions(Disks& d, const Domain& box, const Executor& executor, CellList& cells) {
  move_all({d.x.data(), d.y.data(), d.vx.data(), d.vy.data(), nullptr, nullptr, box, Motion::none, 0.0, 0.0}, d.size(),
           executor, cells);
}

void find_wall_contacts(Disks& disks, const StepRules& rules, const Executor& executor, FoundContacts& found) {
  if (!has_walls(rules.box)) return;
  std::vector<std::vector<ContactEvent>>& buffers = found.walls;
  while (buffers.size() < executor.blocks(disks.size(), drift_block)) {
    buffers.emplace_back();
    buffers.back().reserve(drift_block / 16);
  }
  buffers.resize(executor.blocks(disks.size(), drift_block));
  if (found.near_walls.size() < buffers.size()) found.near_walls.resize(buffers.size());
  const NearWallsKernel kernel = choose_near_walls_kernel();
  const NearWallsInput in = near_walls_input(disks, rules.box);
  with_view(disks, [&](const auto& d) {
    executor.for_ranges(disks.size(), drift_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& near = found.near_walls[b];
      near.clear();
      kernel(in, begin, end, near);
      buffers[b].clear();
      for (const std::uint32_t i : near) {
        for_each_wall_contact(d, rules, i, [&](const ContactEvent& e) { buffers[b].push_back(e); });
      }
    });
  });
}

}  // namespace carom
