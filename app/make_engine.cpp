#include "app/make_engine.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "core/input_message.hpp"

namespace carom {

EngineChoice choose_engine(const std::string& engine, std::optional<int> /*threads*/, const Scene& scene) {
  constexpr std::array<std::string_view, 1> engines{"reference"};
  if (engine == "parallel") fail_input("--engine", "parallel is not built yet", "expected reference");
  if (!engine.empty() && engine != "reference") {
    fail_input("--engine", fmt::format("there is no engine {}", in_quotes(engine)), expected_one_of(engines, engine));
  }
  if (scene.run.method == Method::exact) {
    fail_input(fmt::format("{}: run.method", scene.file), "exact is not built yet",
               "expected pairwise or rollback (as in --method pairwise)");
  }
  return {"reference", 1};
}

std::unique_ptr<Engine> make_engine(const EngineChoice& /*choice*/, const Scene& scene, State initial) {
  return make_reference_engine(scene, std::move(initial));
}

}  // namespace carom
