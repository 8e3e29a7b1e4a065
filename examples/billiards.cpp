// Billiards: a cue ball is aimed along a ray and shot, and balls that fall into the pockets are taken off the table.
#include <carom/carom.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr double radius = 0.028, mass = 0.17;  // metres, kilograms
constexpr double width = 2.54, height = 1.27;
constexpr double pocket = 0.07;

carom::World table() {
  carom_scene scene = carom::default_scene();
  scene.width = width;
  scene.height = height;
  scene.wall_restitution = 0.8;
  scene.restitution = 0.95;
  scene.method = CAROM_PAIRWISE;
  scene.dt = 1e-3;
  carom::World world(scene);
  world.add({0.6, 0.5 * height, 0.0, 0.0, radius, mass, 0});  // the cue ball is disk 0
  for (int row = 0; row < 5; ++row) {
    for (int k = 0; k <= row; ++k) {
      world.add({1.8 + 1.74 * radius * row, 0.5 * height + 2.01 * radius * (k - 0.5 * row), 0.0, 0.0, radius, mass, 0});
    }
  }
  return world;
}

// Cloth slows every ball with the same deceleration. Carom has no such friction, so the program sets the velocities.
void roll(carom::World& world, std::vector<carom_disk>& balls, double seconds) {
  const double loss = 0.3 * seconds;
  balls.resize(world.size());
  world.disks(balls);
  for (const carom_disk& ball : balls) {
    const double speed = std::sqrt(ball.vx * ball.vx + ball.vy * ball.vy);
    if (speed == 0.0) continue;
    const double left = speed > loss ? (speed - loss) / speed : 0.0;
    world.set_velocity(ball.id, left * ball.vx, left * ball.vy);
  }
}

int take_pocketed(carom::World& world) {
  int taken = 0;
  for (const double x : {0.0, 0.5 * width, width}) {
    for (const double y : {0.0, height}) {
      for (const std::uint32_t id : world.disks_in(x - pocket, y - pocket, x + pocket, y + pocket)) {
        world.remove(id);
        ++taken;
      }
    }
  }
  return taken;
}

}  // namespace

int main() {
  try {
    carom::World world = table();
    const carom_disk cue = world.find(0).value();
    // The ray starts at the cue ball's edge, so that it does not meet the cue ball itself.
    const double aim_x = 1.0, aim_y = 0.01;
    const auto hit = world.cast_ray(cue.x + 1.01 * radius, cue.y, aim_x, aim_y, 5.0);
    if (hit) std::printf("the aim meets ball %u after %.3f m\n", hit->id, hit->distance);
    world.set_velocity(0, 6.0 * aim_x, 6.0 * aim_y);
    std::vector<carom_disk> balls;
    int pocketed = 0;
    for (int frame = 0; frame < 600; ++frame) {  // ten steps in a frame
      world.step(10);
      roll(world, balls, 0.01);
      pocketed += take_pocketed(world);
    }
    std::printf("%d balls pocketed, %zu on the table, %llu collisions\n", pocketed, world.size(),
                static_cast<unsigned long long>(world.collisions()));
    std::printf("hash %016llx\n", static_cast<unsigned long long>(world.hash()));
  } catch (const carom::Error& error) {
    std::fprintf(stderr, "billiards: %s\n", error.what());
    return 1;
  }
}
