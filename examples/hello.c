/* The smallest use from C: a gas from a scene's text, run for a while, and its results. */
#include <carom/carom.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char scene[] =
    "[box]\n"
    "packing_fraction = 0.3\n"
    "[[disks]]\n"
    "count = 500\n"
    "positions = \"random\"\n"
    "velocities = { maxwell = 1.0 }\n"
    "radius = 0.5\n"
    "mass = 1.0\n"
    "[run]\n"
    "t_end = 10.0\n";

int main(void) {
  carom_world* world = NULL;
  carom_disk first;
  if (carom_from_text(scene, strlen(scene), NULL, &world) != CAROM_OK || carom_run_until(world, 5.0) != CAROM_OK ||
      carom_get(world, 0, &first) != CAROM_OK) {
    fprintf(stderr, "hello: %s\n", carom_error(world));
    carom_destroy(world);
    return 1;
  }
  printf("Carom %s: %zu disks, t = %.3f, %" PRIu64 " collisions, energy %.6f\n", carom_version(), carom_count(world),
         carom_time(world), carom_collisions(world), carom_kinetic_energy(world));
  printf("disk 0 is at (%.3f, %.3f)\n", first.x, first.y);
  printf("hash %016" PRIx64 "\n", carom_hash(world));
  carom_destroy(world);
  return 0;
}
