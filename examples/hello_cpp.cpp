// The same in C++: a box made in memory, some disks in it, a few steps.
#include <carom/carom.hpp>
#include <cstdio>

int main() {
  try {
    carom_scene scene = carom::default_scene();
    scene.width = 40.0;
    scene.height = 20.0;
    scene.gravity = 1.0;
    scene.restitution = 0.9;
    scene.method = CAROM_PAIRWISE;
    scene.dt = 0.005;
    carom::World world(scene);
    for (int k = 0; k < 100; ++k)
      world.add({1.0 + 2.0 * (k % 19), 1.0 + 2.5 * (k / 19), 0.5 * (k % 3), 0.0, 0.8, 1.0, 0});
    world.step(1000);
    std::printf("%zu disks, t = %g, %llu collisions\n", world.size(), world.time(),
                static_cast<unsigned long long>(world.collisions()));
    std::printf("hash %016llx\n", static_cast<unsigned long long>(world.hash()));
  } catch (const carom::Error& error) {
    std::fprintf(stderr, "hello: %s\n", error.what());
    return 1;
  }
}
