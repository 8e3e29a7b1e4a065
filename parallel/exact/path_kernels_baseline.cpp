#include "core/base/kernel_set.hpp"
#include "core/disks/domain.hpp"
#include "parallel/exact/path_kernels.hpp"

namespace carom {

namespace {

// slot_of(i): the index of disk i in the columns.
template <class SlotOf>
void begin(const BegunPaths& job, SlotOf&& slot_of, std::size_t begin, std::size_t end) {
  const BegunPaths in = job;  // a copy in registers, since stores might change the original
  for (std::size_t i = begin; i < end; ++i) {
    DiskRecord& record = in.record[i];
    const bool relists = in.relists_stay && record.partner.is_relist();
    const std::size_t k = slot_of(i);
    record.path = {0.0, in.x[k], in.y[k], in.vx[k], in.vy[k]};
    record.radius = in.radius;
    record.id = in.id[i];
    record.partner = relists ? Partner::relist() : Partner::none();
    record.version = record.partner_version = 0;
    in.entry[i].time = (in.entry[i].time - in.length) - in.early;
  }
}

void begin_paths(const BegunPaths& in, std::size_t first, std::size_t last) {
  begin(
      in, [](std::size_t i) { return i; }, first, last);
}

void end_paths(const EndedPaths& job, std::size_t begin, std::size_t end) {
  const EndedPaths in = job;
  for (std::size_t i = begin; i < end; ++i) {
    const PathSegment& p = in.record[i].path;
    const double s = in.length - p.start;
    double x = p.x;
    double y = p.y;
    if (p.start != in.length) [[likely]] {
      x += p.vx * s;
      y += p.vy * s;
    }
    if (x < in.left || x >= in.right) [[unlikely]]
      x = wrap(x, in.right);
    if (y < in.bottom || y >= in.top) [[unlikely]]
      y = wrap(y, in.top);
    in.x[i] = x;
    in.y[i] = y;
    in.vx[i] = p.vx;
    in.vy[i] = p.vy;
  }
}

}  // namespace

void begin_paths_at(const std::uint32_t* slot, const BegunPaths& in, std::size_t first, std::size_t last) {
  begin(
      in, [slot](std::size_t i) { return std::size_t{slot[i]}; }, first, last);
}

PathKernels path_kernels_baseline() {
  return {begin_paths, end_paths};
}

PathKernels choose_path_kernels() {
  return kernel_set() == KernelSet::avx2 ? path_kernels_avx2() : path_kernels_baseline();
}

}  // namespace carom
