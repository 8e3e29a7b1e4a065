// The symbols exported by libcarom.so.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <set>
#include <string>

namespace {

// They are fixed: a program built against libcarom.so.0 may call these, and no function of the libraries inside.
TEST(ExportedSymbols, AreWhatTheHeaderDeclaresAndNothingElse) {
  std::set<std::string> exported;
  FILE* const symbols = popen("nm -D --defined-only --format=posix '" CAROM_SHARED "'", "r");
  ASSERT_NE(symbols, nullptr);
  char line[1000];
  while (std::fgets(line, sizeof line, symbols) != nullptr) {
    const std::string name(line, std::strcspn(line, " @"));
    if (name != "CAROM_0") exported.insert(name);
  }
  pclose(symbols);
  const std::set<std::string> pinned{"carom_add",
                                     "carom_cast_ray",
                                     "carom_collisions",
                                     "carom_contacts",
                                     "carom_count",
                                     "carom_destroy",
                                     "carom_disks",
                                     "carom_disks_at",
                                     "carom_done",
                                     "carom_emitted",
                                     "carom_end_time",
                                     "carom_error",
                                     "carom_from_checkpoint",
                                     "carom_from_file",
                                     "carom_from_memory",
                                     "carom_from_scene",
                                     "carom_from_text",
                                     "carom_get",
                                     "carom_group_of",
                                     "carom_groups",
                                     "carom_hash",
                                     "carom_height",
                                     "carom_ids",
                                     "carom_kinetic_energy",
                                     "carom_load_memory",
                                     "carom_nearest",
                                     "carom_next_warning",
                                     "carom_options_init",
                                     "carom_positions",
                                     "carom_potential_energy",
                                     "carom_query_box",
                                     "carom_radii",
                                     "carom_remove",
                                     "carom_removed",
                                     "carom_run_until",
                                     "carom_run_while",
                                     "carom_save",
                                     "carom_save_memory",
                                     "carom_scene_init",
                                     "carom_set_velocity",
                                     "carom_spins",
                                     "carom_status_text",
                                     "carom_step",
                                     "carom_steps",
                                     "carom_time",
                                     "carom_velocities",
                                     "carom_version",
                                     "carom_wall_collisions",
                                     "carom_width"};
  EXPECT_EQ(exported, pinned);
}

}  // namespace
