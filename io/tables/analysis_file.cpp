#include "io/tables/analysis_file.hpp"

#include <algorithm>
#include <cstdint>

#include "core/base/blocking_error.hpp"
#include "core/base/sample_mean.hpp"
#include "core/measure/analysis_curves.hpp"
#include "core/measure/measured_means.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_text.hpp"
#include "io/files/output_file.hpp"
#include "io/hdf5/hdf5_kinds.hpp"
#include "io/hdf5/hdf5_output.hpp"

namespace carom {

namespace {

// Entries of a chunk; with few of them the file of a short run stays small.
constexpr hsize_t chunk = 256;

constexpr const char* meaning_of_psi6 = "psi6 of a disk is the mean of exp(6 i angle) over its six nearest neighbours.";

// Datasets of one group, each with its unit.
class Group {
 public:
  Group(Hdf5Output& output, std::string name) : output_(output), name_(std::move(name)) { output_.make_group(name_); }

  void numbers(const char* name, const std::vector<double>& values, const char* unit) const {
    put(name, double_kind(), Extent{values.size()}, values.data());
    output_.attribute(name_ + "/" + name, "unit", unit);
  }
  // Rows of equal length; their values one after the other.
  void table(const char* name, const std::vector<double>& values, std::size_t rows, const char* unit) const {
    put(name, double_kind(), rows_of(values.size(), rows), values.data());
    output_.attribute(name_ + "/" + name, "unit", unit);
  }
  // Whole numbers, which may be stored as double.
  template <class Number>
  void counts(const char* name, const std::vector<Number>& values) const {
    const std::vector<std::int64_t> signed_values(values.begin(), values.end());
    put(name, count_kind(), Extent{values.size()}, signed_values.data());
  }
  template <class Number>
  void table_of_counts(const char* name, const std::vector<Number>& values, std::size_t rows) const {
    const std::vector<std::int64_t> signed_values(values.begin(), values.end());
    put(name, count_kind(), rows_of(values.size(), rows), signed_values.data());
  }
  void say(const char* name, double number) const { output_.attribute(name_, name, number); }
  void say(const char* name, const std::string& text) const { output_.attribute(name_, name, text); }

 private:
  static Extent rows_of(std::size_t values, std::size_t rows) { return {rows, rows > 0 ? values / rows : 0}; }

  void put(const char* name, const Hdf5Kind& kind, const Extent& extent, const void* data) const {
    Extent chunks;
    bool empty = false;
    for (const hsize_t size : extent) {
      chunks.push_back(std::max<hsize_t>(1, std::min<hsize_t>(size, chunk)));
      empty = empty || size == 0;
    }
    const Hdf5Handle set = output_.make_dataset(name_ + "/" + name, kind, extent, extent, chunks, Packing::plain);
    if (!empty) output_.write_block(set, kind, Extent(extent.size(), 0), extent, data);
  }

  Hdf5Output& output_;
  std::string name_;
};

void put_means(const Group& group, const std::vector<double>& series, const std::vector<double>& interval,
               const char* unit) {
  group.numbers("value", series, unit);
  group.numbers("interval", interval, "time");
  const SampleMean mean = sample_mean(series, interval);
  group.say("mean", mean.mean);
  group.say("standard_deviation", mean.deviation);
  group.say("standard_error", blocking_error(series, interval));
  group.say("samples", static_cast<double>(mean.samples));
}

void put_series(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const AnalysisPlan& plan = scene.analysis;
  const SampleSeries& series = record.series;
  const Group samples(output, "/samples");
  samples.numbers("time", series.time, "time");
  samples.counts("disks", series.disks);
  if (!series.temperature.empty()) samples.numbers("temperature", series.temperature, "energy");
  if (plan.wants(Quantity::displacement)) {
    const Group group(output, "/displacement");
    group.numbers("mean_square", series.displacement, "length^2");
    group.counts("disks", series.followed);
    group.say("meaning",
              std::string("The mean of (r(t) - r(0))^2 since the first sample, over the disks of that sample that are "
                          "still in the box.") +
                  (scene.box.shear.acts() ? " Only displacements along y count, across the shear flow." : ""));
    const DiffusionFit fit = diffusion_of(record, scene);
    group.say("diffusion", fit.value);
    group.say("diffusion_error", fit.error);
    group.say("diffusion_from", fit.from);
    group.say("doubtful", static_cast<double>(record.displacement.doubtful));
  }
  if (plan.wants(Quantity::pressure)) {
    const Group group(output, "/pressure");
    put_means(group, series.pressure, series.interval, "energy / length^2");
    group.say(
        "meaning",
        "The kinetic energy plus W / (2 interval), over the area. W is the virial of the collisions and loads in the "
        "interval; the area is that of the box, or between its moving sides.");
  }
  if (plan.wants(Quantity::collision_rate)) {
    const Group group(output, "/collision_rate");
    put_means(group, series.collision_rate, series.interval, "1 / time");
    group.say("meaning", "How often a disk collides with other disks in a unit of time.");
  }
}

void put_partial(Hdf5Output& output, const AnalysisRecord& record, const AnalysisPlan& plan) {
  if (plan.pair_groups.empty()) return;
  const Group group(output, "/pair_correlation/partial");
  const std::vector<PartialCurve> curves = partial_curves(record, plan);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const PartialCurve& curve = curves[k];
    const std::string between = curve.group + ":" + curve.other;
    group.numbers(("g:" + between).c_str(), curve.g, "1");
    group.counts(("pairs:" + between).c_str(), record.partial[k].counts);
  }
  group.say("meaning",
            "For each r of /pair_correlation: the number of pairs of two groups, over the number for as many disks of "
            "each group placed at random.");
}

void put_pairs(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const BinnedCurve curve = pair_correlation_curve(record.pairs, scene.analysis);
  const auto samples = static_cast<double>(record.series.time.size());
  const Group group(output, "/pair_correlation");
  group.numbers("r", curve.middle, "length");
  group.numbers("g", curve.value, "1");
  group.counts("pairs", record.pairs.counts);
  group.say("samples", samples);
  group.say("bin_width", scene.analysis.pairs.r_max / static_cast<double>(scene.analysis.pairs.bins));
  group.say("centres", static_cast<double>(record.pairs.centres) / samples);
  group.say(
      "meaning",
      "The number of pairs at a distance, over the number for as many disks placed at random. centres is the mean "
      "number of disks around which pairs were counted: all disks except those near sides that are not periodic.");
  put_partial(output, record, scene.analysis);
}

void put_speeds(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const BinnedCurve measured = speed_curve(record, scene.analysis);
  const auto samples = static_cast<double>(record.speeds.samples);
  const Group group(output, "/speeds");
  group.numbers("u", measured.middle, "sqrt(T / m)");
  group.numbers("measured", measured.value, "1");
  group.numbers("maxwell", maxwell_curve(scene.analysis).value, "1");
  group.counts("counts", record.speeds.counts);
  group.say("samples", samples);
  group.say("beyond", static_cast<double>(record.speeds.beyond));
  group.say("temperature", record.speeds.temperature_sum / samples);
  group.say("meaning",
            "The distribution of u = v sqrt(m / T), where T is the mean kinetic energy of the disks of a sample. In "
            "equilibrium it is u exp(-u^2 / 2). beyond is the number of speeds above the last bin.");
}

void append_to(std::vector<double>& all, const std::vector<double>& row) {
  all.insert(all.end(), row.begin(), row.end());
}

// The profile of each part of the run.
void put_profile_rows(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  if (!(scene.analysis.profile_every > 0.0)) return;
  const std::vector<MotionProfile> of_run = motion_rows_of_run(record, scene);
  const std::size_t rows = of_run.size();
  ProfileCurves all;
  std::vector<Count> disks, samples;
  for (const MotionProfile& row : of_run) {
    const ProfileCurves curves = profile_curves(row, scene);
    append_to(all.vx, curves.vx);
    append_to(all.vy, curves.vy);
    append_to(all.temperature, curves.temperature);
    disks.insert(disks.end(), row.disks.begin(), row.disks.end());
    samples.push_back(row.samples);
  }
  const Group group(output, "/profile/rows");
  group.numbers("time", row_times(rows, scene.analysis.profile_every, scene), "time");
  group.table("velocity_x", all.vx, rows, "length / time");
  group.table("velocity_y", all.vy, rows, "length / time");
  group.table("temperature", all.temperature, rows, "energy");
  group.table_of_counts("disks", disks, rows);
  group.counts("samples", samples);
  group.say("meaning", "Each row is the mean over a part of the run, from the time of the row to that of the next.");
}

void put_density_rows(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  if (!(scene.analysis.density_every > 0.0)) return;
  const std::vector<DensityProfile> of_run = density_rows_of_run(record, scene);
  const std::size_t rows = of_run.size();
  std::vector<double> packing, number;
  std::vector<Count> samples;
  for (const DensityProfile& row : of_run) {
    append_to(packing, packing_curve(row, scene).value);
    append_to(number, number_density_curve(row, scene).value);
    samples.push_back(row.samples);
  }
  const Group group(output, "/density/rows");
  group.numbers("time", row_times(rows, scene.analysis.density_every, scene), "time");
  group.table("packing_fraction", packing, rows, "1");
  group.table("number_density", number, rows, "1 / length^2");
  group.counts("samples", samples);
  group.say("meaning", "Each row is the mean over a part of the run, from the time of the row to that of the next.");
}

void put_profile(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const ProfileCurves curves = profile_curves(record.motion, scene);
  const Group group(output, "/profile");
  group.numbers("position", curves.position, "length");
  group.numbers("velocity_x", curves.vx, "length / time");
  group.numbers("velocity_y", curves.vy, "length / time");
  group.numbers("temperature", curves.temperature, "energy");
  group.counts("disks", record.motion.disks);
  group.say("samples", static_cast<double>(record.motion.samples));
  group.say("axis", std::string(axis_names[scene.analysis.profile_along_x ? 0 : 1]));
  group.say(
      "meaning",
      "In each slab: the mean velocity of its disks, which is momentum over mass, and their temperature, the mean "
      "kinetic energy of a disk relative to that velocity.");
  put_profile_rows(output, record, scene);
}

void put_structure(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const Group group(output, "/structure_factor");
  const auto put = [&](const StructureCurve& curve, const char* k, const char* s) {
    if (curve.k.empty()) return;
    group.numbers(k, curve.k, "1 / length");
    group.numbers(s, curve.s, "1");
  };
  put(structure_along_x(record, scene), "kx", "along_x");
  put(structure_along_y(record, scene), "ky", "along_y");
  group.say("samples", static_cast<double>(record.structure.samples));
  group.say("meaning",
            std::string("|sum of exp(i k x)|^2 over the number of disks, as a mean over the samples.") +
                (scene.box.shear.acts() ? " Along x, ky is the smallest that the shifted images of a sheared "
                                          "box allow; it is at most pi / height."
                                        : ""));
}

void put_order(Hdf5Output& output, const AnalysisRecord& record) {
  const Group group(output, "/bond_order");
  const auto put = [&](const char* name, const std::vector<double>& series) {
    group.numbers(name, series, "1");
    group.say((std::string(name) + "_mean").c_str(), sample_mean(series).mean);
    group.say((std::string(name) + "_standard_error").c_str(), blocking_error(series));
  };
  put("local", record.series.local_order);
  put("global", record.series.global_order);
  group.say("meaning",
            std::string(meaning_of_psi6) + " local is the mean of |psi6| over all disks, global is |mean of psi6|.");
}

void put_memory(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const Group group(output, "/velocity_autocorrelation");
  group.numbers("value", record.series.autocorrelation, "length^2 / time^2");
  group.say("meaning",
            std::string("The mean of v(0) v(t) over the disks of the first sample that are still in the box.") +
                (scene.box.shear.acts() ? " Velocities are relative to the shear flow." : ""));
}

void put_bond_memory(Hdf5Output& output, const AnalysisRecord& record) {
  const Group group(output, "/bond_autocorrelation");
  group.numbers("value", record.series.bond_autocorrelation, "1");
  group.say(
      "meaning",
      std::string("g6(t) is the sum of Re(psi6(0)* psi6(t)) over the sum of |psi6(0)|^2, both over the disks of the "
                  "first sample that are still in the box. ") +
          meaning_of_psi6);
}

void put_density(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const BinnedCurve packing = packing_curve(record.density, scene);
  const Group group(output, "/density");
  group.numbers("position", packing.middle, "length");
  group.numbers("packing_fraction", packing.value, "1");
  group.numbers("number_density", number_density_curve(record.density, scene).value, "1 / length^2");
  group.counts("centres", record.density.centres);
  group.say("samples", static_cast<double>(record.density.samples));
  group.say("axis", std::string(axis_names[scene.analysis.density_along_x ? 0 : 1]));
  put_density_rows(output, record, scene);
}

void put_bonds(Hdf5Output& output, const AnalysisRecord& record, const Scene& scene) {
  const BinnedCurve curve = bond_correlation_curve(record, scene.analysis);
  const Group group(output, "/bond_correlation");
  group.numbers("r", curve.middle, "length");
  group.numbers("g6", curve.value, "1");
  group.counts("pairs", record.bonds.pairs);
  group.say("samples", static_cast<double>(record.bonds.samples));
  group.say("meaning",
            std::string("The mean of Re(psi6* psi6') over all pairs of disks at the distance r. ") + meaning_of_psi6);
}

}  // namespace

void write_analysis(const std::string& path, const Scene& scene, const AnalysisRecord& record) {
  const AnalysisPlan& plan = scene.analysis;
  Hdf5Output output(path);
  output.attribute("/", "creator", "Carom " CAROM_VERSION);
  output.make_group("/parameters");
  output.text("/parameters/scene", resolved_toml(scene));
  put_series(output, record, scene);
  if (plan.wants(Quantity::pair_correlation)) put_pairs(output, record, scene);
  if (plan.wants(Quantity::speeds)) put_speeds(output, record, scene);
  if (plan.wants(Quantity::density)) put_density(output, record, scene);
  if (plan.wants(Quantity::profile)) put_profile(output, record, scene);
  if (plan.wants(Quantity::velocity_autocorrelation)) put_memory(output, record, scene);
  if (plan.wants(Quantity::structure_factor)) put_structure(output, record, scene);
  if (plan.wants(Quantity::bond_order)) put_order(output, record);
  if (plan.wants(Quantity::bond_correlation)) put_bonds(output, record, scene);
  if (plan.wants(Quantity::bond_autocorrelation)) put_bond_memory(output, record);
  replace_file(path, output.image());
}

}  // namespace carom
