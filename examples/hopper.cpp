// A hopper: disks flow through an opening and leave through the bottom; the flow is measured for two openings. In two
// dimensions Beverloo's law says that the flow grows as (D - k d)^(3/2) with the opening D and the diameter d.
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>
#include <string>

namespace {

constexpr double width = 12.0, neck = 8.0;  // height of the opening
constexpr double radius = 0.25;

// A silo of disks above a funnel whose sides slope at 45 degrees.
std::string scene_with(double opening) {
  const double half = 0.5 * (width - opening);
  const auto number = [](double x) { return std::to_string(x); };
  return "[box]\nwidth = " + number(width) +
         "\nheight = 30.0\nbottom = \"sink\"\n[physics]\ngravity = 10.0\nrestitution = 0.5\n" +
         "[[walls]]\npoints = [[0.0, " + number(neck + half) + "], [" + number(half) + ", " + number(neck) + "]]\n" +
         "[[walls]]\npoints = [[" + number(width) + ", " + number(neck + half) + "], [" + number(width - half) + ", " +
         number(neck) + "]]\n[[disks]]\ncount = 400\npositions = \"random\"\nregion = [0.0, 13.5, 12.0, 30.0]\n" +
         "radius = { uniform = [0.22, 0.28] }\nmass = { from_radius = 1.0 }\n[run]\nmethod = \"pairwise\"\ndt = "
         "0.002\nt_end = 100.0\n";
}

// Disks per unit of time, from the 50th to the 250th that leaves.
double flow_through(double opening, unsigned long long& hash) {
  carom::World world = carom::World::from_text(scene_with(opening));
  double first = 0.0;
  while (world.removed() < 250 && world.time() < 100.0) {
    world.step(10);
    if (world.removed() < 50) first = world.time();
  }
  hash = world.hash();
  return 200.0 / (world.time() - first);
}

}  // namespace

int main() {
  try {
    unsigned long long hash = 0;
    const double narrow = flow_through(2.0, hash);
    const double wide = flow_through(4.0, hash);
    const double law = std::pow((4.0 - radius) / (2.0 - radius), 1.5);  // k = 1/2, the value for disks without friction
    std::printf("%.1f disks a second through 2, %.1f through 4: %.2f times as many; the law says %.2f\n", narrow, wide,
                wide / narrow, law);
    std::printf("hash %016llx\n", hash);
  } catch (const carom::Error& error) {
    std::fprintf(stderr, "hopper: %s\n", error.what());
    return 1;
  }
}
