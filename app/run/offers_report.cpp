#include "app/run/offers_report.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/base/short_number.hpp"
#include "core/load/method_choice.hpp"
#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

std::string offer_text(const MethodOffer& offer, bool best) {
  const std::string_view name = name_of(offer.method);
  if (!offer.possible) return fmt::format("  {:<10}no: {}\n", name, offer.why);
  const std::string dt = offer.dt > 0.0 ? fmt::format("dt = {:g}, ", offer.dt) : "";
  const std::string error = offer.error > 0.0 ? fmt::format("{:.1e}", offer.error) : "rounding only";
  return fmt::format("{}{:<10}{}error {}, about {} of one core: {}\n", best ? "> " : "  ", name, dt, error,
                     duration_text(offer.seconds), offer.why);
}

// The quantities whose error is meant.
const char* averages_of(const Scene& scene, const MethodChoice& choice) {
  if (scene.physics.diffusion > 0.0) return "mean square displacement";
  // If disks come to rest, the number of their further collisions depends on the step: soft hits become load.
  if (choice.scales.settles) return "energy lost; not collisions, whose number in a pile depends on the steps";
  return disks_dissipate(scene) ? "collision rate, pressure, cooling rate" : "collision rate, pressure";
}

}  // namespace

std::string offers_text(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  std::string text =
      fmt::format("for an error of {:g} in averages over disks and time ({}):\n", accuracy, averages_of(scene, choice));
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    text += offer_text(choice.offers[k], static_cast<int>(k) == choice.best);
  }
  if (choice.offers.empty()) return text + fmt::format("  {}\n", choice.why);
  if (choice.best < 0) return text + "  no method reaches it: use a larger error, or state a method and its dt\n";
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  const std::string dt = best.dt > 0.0 ? fmt::format(" --dt {:g}", best.dt) : "";
  const std::string automatic =
      scene.box.shear.acts() ? "" : fmt::format(", or method = \"auto\", accuracy = {:g} in [run]", accuracy);
  return text + fmt::format("  use it with --method {}{}{}\n", name_of(best.method), dt, automatic);
}

nlohmann::ordered_json offers_json(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  nlohmann::ordered_json j{{"accuracy", accuracy}, {"method", nullptr}, {"why", choice.why}};
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    const MethodOffer& o = choice.offers[k];
    const std::string_view name = name_of(o.method);
    if (static_cast<int>(k) == choice.best) j["method"] = name;
    j["offers"].push_back({{"method", name},
                           {"possible", o.possible},
                           {"dt", o.dt},
                           {"error", o.error},
                           {"cpu_s", o.seconds},
                           {"why", o.why}});
  }
  return j;
}

}  // namespace carom
