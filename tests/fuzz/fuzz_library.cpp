// Any calls of the C library in any order and with any numbers give a status and a text, and never a crash.
#include <carom/carom.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace {

// Reads calls and their numbers from the fuzzer's bytes; returns 0 after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  bool done() const { return left_ == 0; }
  unsigned byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  // Mostly a number of the order of the box's size, sometimes arbitrary bits.
  double number() {
    const unsigned kind = byte();
    if (kind < 230) return (kind - 10.0) / 10.0;
    double any = 0.0;
    if (left_ < sizeof any) return std::numeric_limits<double>::quiet_NaN();
    std::memcpy(&any, data_, sizeof any);
    data_ += sizeof any;
    left_ -= sizeof any;
    return any;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

void check(const carom_world* world, carom_status status) {
  if (status < CAROM_OK || status > CAROM_NOT_FOUND) std::abort();
  if (status != CAROM_OK && *carom_error(world) == '\0') std::abort();
}

carom_status call(carom_world* world, Bytes& in, std::vector<char>& saved) {
  std::uint32_t ids[8];
  std::size_t size = 0;
  double time = 0.0;
  carom_disk disks[8];
  carom_hit hit;
  carom_contact contacts[4];
  switch (in.byte() % 15) {
    case 0:
    case 1: {
      const double x = in.number(), y = in.number(), vx = in.number(), vy = in.number();
      const carom_disk disk{x, y, vx, vy, 0.1 * in.number(), in.number(), 0};
      return carom_add(world, &disk, nullptr);
    }
    case 2:
      return carom_remove(world, in.byte() % 16);
    case 3: {
      const std::uint32_t id = in.byte() % 16;
      const double vx = in.number();
      return carom_set_velocity(world, id, vx, in.number());
    }
    case 4: {
      const double x0 = in.number(), y0 = in.number(), x1 = in.number();
      return carom_query_box(world, x0, y0, x1, in.number(), ids, 8, &size);
    }
    case 5: {
      const double x = in.number();
      return carom_nearest(world, x, in.number(), ids, &time);
    }
    case 6: {
      const double x = in.number(), y = in.number(), dx = in.number(), dy = in.number();
      return carom_cast_ray(world, x, y, dx, dy, in.number(), &hit);
    }
    case 7:
      return carom_disks_at(world, in.number(), disks, in.byte() % 9, &size, &time);
    case 8:
      return carom_disks(world, disks, in.byte() % 9);
    case 9: {
      saved.resize(in.byte() * 16);
      const carom_status status = carom_save_memory(world, saved.data(), saved.size(), &size);
      if (status == CAROM_OK) saved.resize(size);
      return status;
    }
    case 10:
      if (!saved.empty() && in.byte() % 2 == 0) saved[in.byte() % saved.size()] ^= static_cast<char>(in.byte());
      return carom_load_memory(world, saved.data(), saved.size());
    case 11:
      return carom_contacts(world, contacts, in.byte() % 5, &size);
    default:
      return carom_step(world, in.byte() % 4);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  carom_scene scene;
  carom_scene_init(&scene);
  scene.width = 20.0;
  scene.height = 10.0;
  scene.method = static_cast<int>(in.byte() % 3);
  scene.left = scene.right = in.byte() % 2 == 0 ? CAROM_PERIODIC : CAROM_WALL;
  scene.restitution = in.byte() % 2 == 0 ? 1.0 : 0.9;
  scene.gravity = in.byte() % 2 == 0 ? 0.0 : 1.0;
  scene.dt = 0.01;
  carom_world* world = nullptr;
  if (carom_from_scene(&scene, nullptr, &world) != CAROM_OK) std::abort();
  std::vector<char> saved;
  // A PhysicsError ends the run, since a world with a disk too fast for its step raises one in every step.
  for (int k = 0; k < 200 && !in.done(); ++k) {
    const carom_status status = call(world, in, saved);
    check(world, status);
    if (status == CAROM_PHYSICS) break;
  }
  carom_destroy(world);
  return 0;
}
