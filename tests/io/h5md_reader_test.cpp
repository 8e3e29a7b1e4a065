// trajectory.h5 as a reader finds it: of a run that is going on or was killed, and with parts that do not match.
#include "io/trajectory/h5md_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "core/base/check.hpp"
#include "core/measure/invariants.hpp"
#include "io/trajectory/trajectory_h5md.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr Count disks_of_block = 2;

// Two groups of two rough disks each, and a source, so that disks may be added.
Scene rough_scene() {
  Scene scene = test::scene_of(Method::pairwise, 100.0, 50.0, 0.5, 50.0);
  scene.groups.resize(2);
  for (DiskGroup& group : scene.groups) group.count = disks_of_block;
  scene.sources.resize(1);
  scene.physics.surfaces.inertia = 0.5;
  return scene;
}

Disks disks_at(Count frame, DiskId count) {
  Disks disks;
  disks.inertia = 0.5;
  const auto k = static_cast<double>(frame);
  for (DiskId id = 0; id < count; ++id) append(disks, {1.0 + id, k, 2.0 + id, 3.0, 0.5, 1.0 + id, id, 0.25 * id + k});
  return disks;
}

class H5mdFile : public ::testing::Test {
 protected:
  void write(const Scene& scene, Count frames, DiskId count = 5) const {
    H5mdWriter writer(path_, scene);
    for (Count k = 0; k < frames; ++k) writer.write(disks_at(k, count), static_cast<double>(k), 7 * k, {});
    writer.close();
  }
  // Opens the file and calls change() with one of its datasets.
  void change_at(const std::string& name, const std::function<void(hid_t file, hid_t set)>& change) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    ASSERT_GE(set, 0) << name;
    change(file, set);
    H5Dclose(set);
    H5Fclose(file);
  }
  void change(const std::string& name, const std::function<void(hid_t file, hid_t set)>& how) const {
    change_at("/particles/disks/" + name, how);
  }
  void resize(const std::string& name, const std::vector<hsize_t>& size) const {
    change(name, [&](hid_t, hid_t set) { ASSERT_GE(H5Dset_extent(set, size.data()), 0); });
  }
  // Writes one number of a dataset.
  void put(const std::string& name, const std::vector<hsize_t>& at, double value) const {
    change(name, [&](hid_t, hid_t set) {
      const hid_t space = H5Dget_space(set);
      const hid_t one = H5Screate(H5S_SCALAR);
      H5Sselect_elements(space, H5S_SELECT_SET, 1, at.data());
      ASSERT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &value), 0);
      H5Sclose(one);
      H5Sclose(space);
    });
  }
  // Replaces a dataset by one of zeros with another shape.
  void replace(const std::string& name, const std::vector<hsize_t>& size) const {
    change(name, [&](hid_t file, hid_t) {
      const std::string whole = "/particles/disks/" + name;
      H5Ldelete(file, whole.c_str(), H5P_DEFAULT);
      const hid_t space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
      const hid_t set = H5Dcreate2(file, whole.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      ASSERT_GE(set, 0);
      H5Dclose(set);
      H5Sclose(space);
    });
  }
  // The error when the file is read to its end.
  std::string error() const {
    try {
      H5mdReader reader(path_);
      TrajectoryFrame frame;
      while (reader.read(frame)) {
      }
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string path_ = (folder_.path() / "trajectory.h5").string();
};

TEST_F(H5mdFile, GivesGroupsAndSpins) {
  for (const bool single : {false, true}) {
    Scene scene = rough_scene();
    scene.output.single_precision = single;
    write(scene, 2);
    const hsize_t each = single ? sizeof(float) : sizeof(double);
    change("angular_velocity/value", [&](hid_t, hid_t set) {
      const hid_t type = H5Dget_type(set);
      EXPECT_EQ(H5Tget_size(type), each);
      H5Tclose(type);
    });
    H5mdReader reader(path_);
    TrajectoryFrame frame;
    ASSERT_TRUE(reader.read(frame) && reader.read(frame));
    EXPECT_THAT(frame.group, ElementsAre(0U, 0U, 1U, 1U, 2U)) << "the last disk came from a source";
    EXPECT_THAT(frame.disks.spin, ElementsAre(1.0, 1.25, 1.5, 1.75, 2.0));
    EXPECT_EQ(reader.frames(), 2U);
  }
}

// A writer killed while disks were added may have enlarged some datasets and not others.
TEST_F(H5mdFile, PlacesThatNotAllHaveYetAreNone) {
  for (const char* const name : {"velocity/value", "position/value", "angular_velocity/value"}) {
    write(rough_scene(), 2);
    std::vector<hsize_t> size{2, 3};
    if (name[0] != 'a') size.push_back(2);
    resize(name, size);
    H5mdReader reader(path_);
    TrajectoryFrame frame;
    ASSERT_TRUE(reader.read(frame)) << name;
    EXPECT_THAT(frame.disks.id, ElementsAre(0U, 1U, 2U)) << name;
    EXPECT_THAT(frame.disks.vx, ElementsAre(2.0, 3.0, 4.0)) << name;
  }
}

TEST_F(H5mdFile, PartsThatDoNotGoTogetherAreNamed) {
  for (const char* const name : {"radius", "mass", "species"}) {
    write(rough_scene(), 2);
    resize(name, {3});
    EXPECT_EQ(error(), path_ + ": disk 3 has no radius, mass or species; expected a trajectory.h5 that Carom wrote");
  }
  for (const char* const name : {"velocity/value", "position/value"}) {
    write(rough_scene(), 3);
    resize(name, {1, 5, 2});
    EXPECT_EQ(error(), path_ + ": frame 2 is missing; expected a trajectory.h5 that Carom wrote") << name;
  }
  for (const std::vector<hsize_t>& shape :
       {std::vector<hsize_t>{2, 5, 3}, std::vector<hsize_t>{2, 5}, std::vector<hsize_t>{2, 5, 2, 1}}) {
    write(rough_scene(), 2);
    replace("velocity/value", shape);
    EXPECT_THAT(error(), HasSubstr("its datasets have other shapes"));
  }
  for (const std::vector<hsize_t>& shape : {std::vector<hsize_t>{2, 5, 1}, std::vector<hsize_t>{2, 5}}) {
    write(rough_scene(), 2);
    replace("position/value", shape);
    EXPECT_THAT(error(), HasSubstr("its datasets have other shapes"));
  }
  for (const std::vector<hsize_t>& shape : {std::vector<hsize_t>{3}, std::vector<hsize_t>{1}}) {
    write(rough_scene(), 2);
    replace("box/edges", shape);
    EXPECT_THAT(error(), HasSubstr("has no box of two edges"));
  }
  Scene deep = rough_scene();
  deep.output.dimensions = 3;
  for (const std::vector<hsize_t>& shape : {std::vector<hsize_t>{2, 3}, std::vector<hsize_t>{2, 3, 2}}) {
    write(deep, 2);
    replace("box/edges/value", shape);
    EXPECT_THAT(error(), HasSubstr("has no box of three edges"));
  }
}

TEST_F(H5mdFile, ValuesThatNoDiskHasAreNamed) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::string no_number =
      path_ + ": frame 2: disk 3 has a value that is not a number; expected a trajectory.h5 that Carom wrote";
  for (const char* const name : {"position/value", "velocity/value"}) {
    for (const hsize_t component : {0U, 1U}) {
      write(rough_scene(), 2);
      put(name, {1, 3, component}, nothing);
      EXPECT_EQ(error(), no_number) << name;
    }
  }
  write(rough_scene(), 2);
  put("angular_velocity/value", {1, 3}, nothing);
  EXPECT_EQ(error(), no_number);
  for (const char* const name : {"radius", "mass"}) {
    write(rough_scene(), 2);
    put(name, {3}, std::numeric_limits<double>::infinity());
    EXPECT_THAT(error(), HasSubstr("frame 1: disk 3 has a value that is not a number")) << name;
  }
  Scene deep = rough_scene();
  deep.output.dimensions = 3;
  for (const char* const name : {"position/value", "velocity/value"}) {
    write(deep, 2);
    EXPECT_EQ(error(), "no error");
    put(name, {1, 4, 2}, 1e-9);
    EXPECT_THAT(error(), HasSubstr("frame 2: disk 4 has left the plane z = 0")) << name;
  }
}

// A kill between two writes leaves HDF5's mark "being written" in the file: readers, and a run that goes on, must
// ignore it.
TEST_F(H5mdFile, TheMarkOfAWriterThatIsGoneIsNoHindrance) {
  write(rough_scene(), 3);
  const pid_t child = fork();
  if (child == 0) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, access);
    const bool marked = file >= 0 && H5Fstart_swmr_write(file) >= 0 && H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
    _exit(marked ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  ASSERT_LT(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), 0) << "HDF5 itself refuses it";
  EXPECT_EQ(error(), "no error");
  H5mdWriter writer(path_, rough_scene(), 3);
  writer.write(disks_at(3, 5), 3.0, 21, {});
  writer.close();
  H5mdReader reader(path_);
  EXPECT_EQ(reader.frames(), 4U);
}

TEST_F(H5mdFile, FramesArePassedOver) {
  write(rough_scene(), 3);
  H5mdReader reader(path_);
  TrajectoryFrame frame;
  EXPECT_TRUE(reader.skip() && reader.skip());
  ASSERT_TRUE(reader.read(frame));
  EXPECT_EQ(frame.time, 2.0);
  EXPECT_FALSE(reader.skip());
}

TEST_F(H5mdFile, AGrowingFileIsReadOn) {
  H5mdWriter writer(path_, rough_scene());
  H5mdReader growing(path_, true);
  TrajectoryFrame frame;
  EXPECT_FALSE(growing.read(frame));
  for (Count k = 0; k < 3; ++k) {
    writer.write(disks_at(k, 5), static_cast<double>(k), k, {});
    writer.flush();
    ASSERT_TRUE(growing.read(frame));
    EXPECT_EQ(frame.time, static_cast<double>(k));
    EXPECT_FALSE(growing.read(frame));
  }
  H5mdReader whole(path_);
  while (whole.read(frame)) {
  }
  writer.write(disks_at(3, 5), 3.0, 3, {});
  writer.close();
  EXPECT_FALSE(whole.read(frame)) << "this reader reads the file as it was when opened";
  // While the file is being moved the reader finds nothing more, and no error.
  const std::string elsewhere = (folder_.path() / "moved.h5").string();
  std::filesystem::rename(path_, elsewhere);
  EXPECT_FALSE(growing.read(frame));
  growing.follow(elsewhere);
  ASSERT_TRUE(growing.read(frame));
  EXPECT_EQ(frame.time, 3.0);
}

// Radii, masses and species that a killed writer left incomplete are completed by the run that goes on.
TEST_F(H5mdFile, WhatIsKnownForEverIsFilledUp) {
  for (const char* const name : {"radius", "mass", "species"}) {
    write(rough_scene(), 3);
    resize(name, {3});
    H5mdWriter writer(path_, rough_scene(), 2);
    writer.write(disks_at(2, 5), 2.0, 14, {});
    writer.close();
    H5mdReader reader(path_);
    TrajectoryFrame frame;
    ASSERT_TRUE(reader.read(frame)) << name;
    EXPECT_THAT(frame.disks.mass, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0)) << name;
    EXPECT_THAT(frame.disks.radius, ElementsAre(0.5, 0.5, 0.5, 0.5, 0.5)) << name;
    EXPECT_THAT(frame.group, ElementsAre(0U, 0U, 1U, 1U, 2U)) << name;
  }
}

// Disks added by a program before the file begins have their rows, even if no source of the scene emits disks.
TEST_F(H5mdFile, DisksThatAProgramAddedHaveTheirPlaces) {
  Scene scene = rough_scene();
  scene.sources.clear();
  H5mdWriter writer(path_, scene, nullptr, 6);
  writer.write(disks_at(0, 6), 0.0, 0, {});
  writer.close();
  H5mdReader reader(path_);
  TrajectoryFrame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT(frame.disks.id, ElementsAre(0U, 1U, 2U, 3U, 4U, 5U));
  EXPECT_THAT(frame.disks.mass, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
}

// If no disk that a source emits is selected, the number of rows in the file is fixed.
TEST_F(H5mdFile, PlacesAreAddedOnlyWhereDisksMayCome) {
  const auto most_places = [this](DiskId end) {
    Scene scene = rough_scene();
    scene.output.select.ids.end = end;
    write(scene, 1);
    hsize_t most = 0;
    change("mass", [&most](hid_t, hid_t set) {
      const hid_t space = H5Dget_space(set);
      H5Sget_simple_extent_dims(space, nullptr, &most);
      H5Sclose(space);
    });
    return most;
  };
  EXPECT_EQ(most_places(3), 3U);
  EXPECT_EQ(most_places(4), 4U) << "all disks of the start";
  EXPECT_EQ(most_places(5), H5S_UNLIMITED);
}

TEST_F(H5mdFile, OfAnotherShapeItIsNotGoneOnWith) {
  write(rough_scene(), 3);
  Scene other = rough_scene();
  other.output.dimensions = 3;
  EXPECT_THROW(H5mdWriter(path_, other, 2), RunError);
  other = rough_scene();
  other.groups[0].count = 50;
  EXPECT_THROW(H5mdWriter(path_, other, 2), RunError);
}

// Steps are those of time-stepping methods; for exact they are numbers of frames, as several may lie in one window.
TEST_F(H5mdFile, StepsAreThoseOfTheMethod) {
  for (const Method method : {Method::pairwise, Method::exact}) {
    Scene scene = rough_scene();
    scene.run.method = method;
    write(scene, 3);
    change("position/step", [&](hid_t, hid_t set) {
      std::vector<long long> steps(3);
      H5Dread(set, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, steps.data());
      if (method == Method::exact) {
        EXPECT_THAT(steps, ElementsAre(0, 1, 2));
      } else {
        EXPECT_THAT(steps, ElementsAre(0, 7, 14));
      }
    });
  }
}

// Observables of rotation and of named groups are stored under their own names.
TEST_F(H5mdFile, ObservablesStandUnderTheirNames) {
  Scene scene = rough_scene();
  scene.groups[1].name = "second";
  write(scene, 2);
  const auto observable = [&](const std::string& name) {
    double values[2] = {};
    change_at("/observables/" + name + "/value",
              [&](hid_t, hid_t set) { H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values); });
    return values[1];
  };
  double rotational = 0.0;
  const Disks disks = disks_at(1, 5);
  for (std::size_t i = 0; i < disks.size(); ++i) rotational += rotational_energy_of(disks, i);
  EXPECT_EQ(observable("rotational"), rotational);
  EXPECT_EQ(observable("rotational_temperature"), 2.0 * rotational / 5.0);
  EXPECT_EQ(observable("disks_second"), 2.0);
  EXPECT_EQ(observable("vy_second"), 3.0);
}

}  // namespace
}  // namespace carom
