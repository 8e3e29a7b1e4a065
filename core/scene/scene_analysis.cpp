#include "core/scene/scene_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_message.hpp"
#include "core/scene/scene_group_name.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

// More bins would only show noise.
constexpr Count most_bins = 100'000;
struct DefaultDistances {
  std::string_view name;
  double reach, bins_per_diameter;  // diameters, 1
};
// Defaults for pairs: up to five diameters, in bins of a fiftieth, so that a bin begins exactly at the contact of equal
// disks.
constexpr DefaultDistances pair_defaults{"pair_correlation", 5.0, 50.0};
// Bond order reaches further, and has no step at contact.
constexpr DefaultDistances bond_defaults{"bond_correlation", 20.0, 10.0};
// In thermal speeds; less than one disk in 10^7 is faster.
constexpr double default_speed_max = 6.0;
constexpr Count default_speed_bins = 60, default_density_bins = 50, default_wave_numbers = 100;
// Samples of a run if the scene does not say how often.
constexpr double default_samples = 100.0;

void read_wanted(const TableReader& reader, AnalysisPlan& plan) {
  const std::string key = reader.key("what");
  const toml::node& node = reader.require("what", "expected a list of what to measure, as in [\"pair_correlation\"]");
  const toml::array& list = as_list(reader.origin(), key, node, "expected a list of what to measure");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string entry = fmt::format("{}.{}", key, k);
    const std::string name = as_text(reader.origin(), entry, list[k]);
    const auto* const known = std::find(quantity_names.begin(), quantity_names.end(), name);
    if (known == quantity_names.end()) {
      reader.origin().fail(entry, fmt::format("unknown quantity {}", in_quotes(name)),
                           expected_one_of(quantity_names, name));
    }
    plan.wanted[static_cast<std::size_t>(known - quantity_names.begin())] = true;
  }
}

Count read_bins(const TableReader& reader) {
  const Count bins = reader.count("bins").value_or(0);
  if (reader.find("bins") != nullptr && (bins == 0 || bins > most_bins)) {
    reader.fail("bins", fmt::format("is {}", bins), fmt::format("expected a whole number from 1 to {}", most_bins));
  }
  return bins;
}

DistancePlan read_distances(const TableReader& options) {
  DistancePlan distances;
  distances.r_max = options.number("r_max").value_or(0.0);
  distances.bins = read_bins(options);
  return distances;
}

std::vector<NamedIds> read_pair_groups(const TableReader& options, const AnalysisPlan& plan, const Scene& scene) {
  const toml::node* const node = options.find("groups");
  if (node == nullptr) return {};
  if (!plan.group.empty()) {
    options.fail("groups", "cannot be used with analysis.select",
                 "expected one of the two: a selection is a single group");
  }
  const std::string key = options.key("groups");
  const toml::array& list = as_list(options.origin(), key, *node, "expected a list of the names of groups");
  std::vector<NamedIds> groups;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string entry = fmt::format("{}.{}", key, k);
    const std::string name = as_text(options.origin(), entry, list[k]);
    if (std::any_of(groups.begin(), groups.end(), [&](const NamedIds& group) { return group.name == name; })) {
      options.origin().fail(entry, fmt::format("names {} again", in_quotes(name)), "expected each group once");
    }
    groups.push_back({name, find_group(options, fmt::format("groups.{}", k), name, scene)});
  }
  return groups;
}

// Simulated time of a row of a profile; 0: no rows.
double read_rows(const TableReader& options, const AnalysisPlan& plan, const Scene& scene) {
  const double every = options.number("every").value_or(0.0);
  const double rows = every > 0.0 ? (scene.run.t_end - plan.start) / every : 0.0;
  if (rows > static_cast<double>(most_bins)) {
    options.fail(
        "every", fmt::format("is {}, which makes {:.3g} rows", every, rows),
        fmt::format("expected at least {:g}, for {} rows", (scene.run.t_end - plan.start) / most_bins, most_bins));
  }
  return every;
}

// Calls read(table) with the table of options of a quantity, if there is one.
template <class Read>
void read_options(const TableReader& analysis, const AnalysisPlan& plan, Quantity quantity, Read read) {
  const std::string_view name = quantity_names[static_cast<std::size_t>(quantity)];
  const toml::node* node = analysis.find(name);
  if (node == nullptr) return;
  if (!node->is_table()) {
    analysis.fail(
        name, fmt::format("is {}", type_name(*node)),
        fmt::format("expected a table with {}, and its name in what", fmt::join(key_names(analysis.key(name)), ", ")));
  }
  if (!plan.wants(quantity)) {
    analysis.fail(name, "has options, but what does not contain it", fmt::format("expected \"{}\" in what", name));
  }
  read(TableReader(analysis.origin(), analysis.key(name), *node->as_table()));
}

// The largest r_max possible with a side of this length, and the default; both lengths.
struct Reach {
  double most = 0.0, usual = 0.0;
};

Reach reach_along(double length, bool periodic, double radius) {
  if (periodic) return {0.5 * length, 0.5 * length};
  // Pairs are counted around disks that are r_max and a radius away from both walls; by default r_max leaves half of
  // the possible centres for that.
  const double room = 0.5 * length - radius;
  return {room * (1.0 - 1e-9), 0.5 * room};
}

void settle_distances(const Scene& scene, DistancePlan& plan, const DefaultDistances& usual, double largest_radius,
                      const PlaceOfKey& place) {
  const Reach x = reach_along(scene.box.width, scene.box.periodic_x(), largest_radius);
  const Reach y = reach_along(scene.box.height, scene.box.periodic_y(), largest_radius);
  const double most = std::min(x.most, y.most);
  const double diameter = 2.0 * largest_radius;
  if (!(most > 0.0)) {
    fail_input(place("analysis.what"),
               fmt::format("{} has no room: a disk fills the box from wall to wall", usual.name),
               "expected a larger box");
  }
  // The diameter is 0 in a scene without disks.
  if (plan.r_max == 0.0) plan.r_max = std::min({x.usual, y.usual, diameter > 0.0 ? usual.reach * diameter : x.usual});
  const bool periodic = scene.box.periodic_x() && scene.box.periodic_y();
  if (plan.r_max > most) {
    fail_input(
        place(fmt::format("analysis.{}.r_max", usual.name)), fmt::format("{} is too large for the box", plan.r_max),
        fmt::format("expected at most {}, {}", most,
                    periodic ? "half the shorter side" : "half a periodic side, with disks that far from all walls"));
  }
  if (plan.bins == 0) {
    const double bins = diameter > 0.0 ? usual.bins_per_diameter * plan.r_max / diameter : usual.bins_per_diameter;
    plan.bins = static_cast<Count>(std::clamp(std::round(bins), 10.0, static_cast<double>(most_bins)));
  }
  plan.wall_margin = plan.r_max + largest_radius;
}

// Obstacles are not measured; if a group is selected, other disks are not, either.
double largest_measured_radius(const Scene& scene) {
  const IdRange& measured = scene.analysis.ids;
  double largest = 0.0;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    if (!group.fixed && measured.holds(first_id)) {
      largest = std::max(largest, summarise_sizes(group, scene.seed, first_id).largest.radius);
    }
    first_id += static_cast<DiskId>(group.count);
  }
  if (!measured.holds(first_id)) return largest;
  for (const Source& source : scene.sources)
    largest = std::max(largest, ends_of_sizes(source.radius, source.mass).second.radius);
  return largest;
}

void read_sample_times(const TableReader& reader, const Scene& scene, AnalysisPlan& plan) {
  const double usual = scene.output.every > 0.0 ? scene.output.every : scene.run.t_end / default_samples;
  plan.every = reader.number("every").value_or(usual);
  plan.start = reader.number_or_initial("start");
  if (plan.start > scene.run.t_end) {
    reader.fail("start", fmt::format("is {}, after the end of the run", plan.start),
                fmt::format("expected at most run.t_end = {}", scene.run.t_end));
  }
}

Count read_wave_numbers(const TableReader& options) {
  const Count wave_numbers = options.count("wave_numbers").value_or(0);
  if (wave_numbers > most_bins || (wave_numbers == 0 && options.find("wave_numbers") != nullptr)) {
    options.fail("wave_numbers", fmt::format("is {}", wave_numbers),
                 fmt::format("expected a whole number from 1 to {}", most_bins));
  }
  return wave_numbers;
}

// Reads the tables of all quantities that have options.
void read_all_options(const TableReader& reader, const Scene& scene, AnalysisPlan& plan) {
  read_options(reader, plan, Quantity::pair_correlation, [&](const TableReader& options) {
    plan.pairs = read_distances(options);
    plan.pair_groups = read_pair_groups(options, plan, scene);
  });
  read_options(reader, plan, Quantity::bond_correlation,
               [&](const TableReader& options) { plan.bonds = read_distances(options); });
  read_options(reader, plan, Quantity::speeds, [&](const TableReader& options) {
    plan.speed_max = options.number("max").value_or(0.0);
    plan.speed_bins = read_bins(options);
  });
  read_options(reader, plan, Quantity::density, [&](const TableReader& options) {
    plan.density_along_x = options.choice_or_initial("axis") == 0;
    plan.density_bins = read_bins(options);
    plan.density_every = read_rows(options, plan, scene);
  });
  read_options(reader, plan, Quantity::profile, [&](const TableReader& options) {
    plan.profile_along_x = options.choice_or_initial("axis") == 0;
    plan.profile_bins = read_bins(options);
    plan.profile_every = read_rows(options, plan, scene);
  });
  read_options(reader, plan, Quantity::structure_factor,
               [&](const TableReader& options) { plan.wave_numbers = read_wave_numbers(options); });
}

// Sets defaults. Those of distances follow when the sizes of all disks are known (settle_analysis).
void take_defaults(AnalysisPlan& plan) {
  if (plan.profile_bins == 0) plan.profile_bins = default_density_bins;
  if (plan.wave_numbers == 0) plan.wave_numbers = default_wave_numbers;
  if (plan.speed_max == 0.0) plan.speed_max = default_speed_max;
  if (plan.speed_bins == 0) plan.speed_bins = default_speed_bins;
  if (plan.density_bins == 0) plan.density_bins = default_density_bins;
}

}  // namespace

AnalysisPlan read_analysis(const SceneOrigin& origin, const toml::table& table, const Scene& scene) {
  const TableReader reader(origin, "analysis", table);
  AnalysisPlan plan;
  read_wanted(reader, plan);
  plan.group = reader.text("select").value_or("");
  if (reader.find("select") != nullptr) plan.ids = find_group(reader, "select", plan.group, scene);
  read_sample_times(reader, scene, plan);
  read_all_options(reader, scene, plan);
  if (plan.wants(Quantity::structure_factor) && !scene.box.periodic_x() && !scene.box.periodic_y()) {
    reader.fail("what", "structure_factor needs waves along periodic sides, and no side is periodic",
                "expected a periodic box");
  }
  take_defaults(plan);
  return plan;
}

void settle_analysis(Scene& scene, const PlaceOfKey& place) {
  AnalysisPlan& plan = scene.analysis;
  if (!plan.wants(Quantity::pair_correlation) && !plan.wants(Quantity::bond_correlation)) return;
  const double largest_radius = largest_measured_radius(scene);
  if (plan.wants(Quantity::pair_correlation)) settle_distances(scene, plan.pairs, pair_defaults, largest_radius, place);
  if (plan.wants(Quantity::bond_correlation)) settle_distances(scene, plan.bonds, bond_defaults, largest_radius, place);
}

}  // namespace carom
