// Rollback netcode: two players each steer a disk in the same world, computed on two machines. Each machine goes on
// with a guess of the other player's input. When the true input arrives, some frames late, the machine goes back to the
// frame to which the input belongs, and computes again. The worlds agree in every bit, as the hashes show; only inputs
// are sent.
#include <array>
#include <carom/carom.hpp>
#include <cstdio>
#include <vector>

namespace {

constexpr int frames = 300, delay = 6;  // delay of the network, in frames

struct Input {
  double vx = 0.0, vy = 0.0;
};

// A player's input: a new velocity every 25 frames.
Input input_of(int player, int frame) {
  const int turn = frame / 25 + 3 * player;
  return {static_cast<double>(turn % 5 - 2), static_cast<double>((3 * turn) % 7 - 3)};
}

carom::World arena() {
  carom_scene scene = carom::default_scene();
  scene.width = scene.height = 20.0;
  scene.restitution = 0.9;
  scene.method = CAROM_PAIRWISE;
  scene.dt = 1.0 / 240.0;
  carom::World world(scene);
  world.add({4.0, 10.0, 0.0, 0.0, 1.0, 2.0, 0});
  world.add({16.0, 10.0, 0.0, 0.0, 1.0, 2.0, 0});
  for (int k = 0; k < 60; ++k) world.add({1.5 + 1.8 * (k % 10), 1.5 + 1.5 * (k / 10), 0.3, -0.2, 0.4, 0.5, 0});
  return world;
}

// One player's machine.
class Machine {
 public:
  explicit Machine(int player) : player_(player), world_(arena()) {}

  // Computes frame `now`; the other's input of frame now - delay has just arrived.
  void advance(int now) {
    const int arrived = now - delay;
    if (arrived >= 0) {
      known_ = arrived;
      const Input real = input_of(1 - player_, arrived);
      const bool guessed = real.vx == used_[slot(arrived)].vx && real.vy == used_[slot(arrived)].vy;
      if (!guessed) go_back(arrived, now);
    }
    compute(now);
  }
  carom::World& world() { return world_; }
  int rollbacks() const { return rollbacks_; }
  void hear_all(int now) {
    known_ = now;
    go_back(now - delay, now);
  }

 private:
  static std::size_t slot(int frame) { return static_cast<std::size_t>(frame % (delay + 1)); }

  // The guess is that the other goes on with the last known input.
  Input guess(int frame) const { return known_ < 0 ? Input{} : input_of(1 - player_, frame < known_ ? frame : known_); }

  void compute(int frame) {
    world_.save(saved_[slot(frame)]);
    const Input own = input_of(player_, frame), other = guess(frame);
    used_[slot(frame)] = other;
    const Input inputs[2] = {player_ == 0 ? own : other, player_ == 0 ? other : own};
    for (std::uint32_t id = 0; id < 2; ++id) world_.set_velocity(id, inputs[id].vx, inputs[id].vy);
    world_.step(4);
  }
  void go_back(int frame, int now) {
    world_.load(saved_[slot(frame)]);
    for (; frame < now; ++frame) compute(frame);
    ++rollbacks_;
  }

  int player_;
  carom::World world_;
  int known_ = -1;  // the last frame for which the other's input has arrived
  int rollbacks_ = 0;
  std::array<std::vector<std::byte>, delay + 1> saved_;  // the world before each of the last frames
  std::array<Input, delay + 1> used_{};
};

}  // namespace

int main() {
  try {
    Machine one(0), two(1);
    for (int frame = 0; frame < frames; ++frame) {
      one.advance(frame);
      two.advance(frame);
    }
    one.hear_all(frames);
    two.hear_all(frames);
    std::printf("%d frames, %d and %d rollbacks\n", frames, one.rollbacks(), two.rollbacks());
    std::printf("hash %016llx\nhash %016llx\n", static_cast<unsigned long long>(one.world().hash()),
                static_cast<unsigned long long>(two.world().hash()));
    return one.world().hash() == two.world().hash() ? 0 : 1;
  } catch (const carom::Error& error) {
    std::fprintf(stderr, "rollback: %s\n", error.what());
    return 1;
  }
}
