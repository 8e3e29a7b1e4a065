// Running a list of contacts in order over several ranks, with the bits of the serial order. Contacts that share no
// disk commute exactly, so each only has to wait for the earlier ones of its own disks. Those of a rank's own disks run
// on it; those across a border run on both of its sides, where either has both disks. They take turns, in rounds: what
// lies inside the slabs and waits for no border; what lies across borders and waits for that alone; inside again, what
// has waited for those, and so on. Before what lies across borders, each rank sends the disks that others' contacts
// have changed. How many rounds there are is agreed on: few where ids have nothing to do with places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/pair.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/ghost_disks.hpp"
#include "parallel/stepping/patches.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// All functions but counts() are collective.
class BorderRounds {
 public:
  explicit BorderRounds(Ranks& ranks);

  // For the contacts of a search. crossing: those across borders, own disk first, in any order; so many contacts with
  // ghosts have the lists to come, at most.
  void begin(const std::vector<Pair>& crossing, const Disks& disks, const GhostDisks& ghosts);

  // As build_patches. Contacts across a border are in the lists of both its sides, in the same order.
  template <class DisksOf>
  void build(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor, DisksOf&& disks_of) {
    resize_amply(contacts_, contacts);
    for (std::size_t k = 0; k < contacts; ++k) contacts_[k] = disks_of(k);
    agree_on_rounds(disks.size());
    share_out(patches, disks, in_contact, executor);
  }

  // Before each phase of run_patches: what others have of this rank's disks, where the phase lies across borders.
  // values (disk_values.hpp): those of a disk that the contacts change.
  template <class Values>
  void before(std::uint32_t phase, bool backwards, Values values) {
    const std::uint32_t round = round_of_phase_[phase];
    if (round == inside) return;
    std::array<const Route*, most_peers> routes{};
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      routes[p] = &(backwards ? peers_[p].back : peers_[p].forward)[round];
    }
    send_values(routes, values);
  }

  // The same for all disks that have a contact across a border.
  template <class Values>
  void refresh(Values values) {
    std::array<const Route*, most_peers> routes{};
    for (std::size_t p = 0; p < peers_.size(); ++p) routes[p] = &peers_[p].all;
    send_values(routes, values);
  }

  // Are the contacts of a patch counted by this rank? Those across a border are by the lower one.
  bool counts(std::size_t patch) const { return counted_[patch] != 0; }

  std::uint32_t rounds() const { return rounds_; }

 private:
  static constexpr std::size_t most_peers = 2;
  static constexpr std::uint32_t inside = UINT32_MAX;
  static constexpr int none = -1;

  // Own disks whose values go to a rank, and ghosts whose values come from it.
  struct Route {
    std::vector<std::uint32_t> send, receive;
  };
  // A rank with a border to this one.
  struct Peer {
    bool counts = false;  // it counts the contacts across the border
    Route all;
    std::vector<Route> forward, back;     // by rounds of the list
    std::vector<std::uint32_t> contacts;  // of the list, across the border
    std::vector<std::uint32_t> known;     // of each: a round that it cannot be before
    std::vector<unsigned char> wanted;    // of each: in which directions its own disk has to be sent
    std::size_t next = 0;                 // of contacts, in a pass
  };
  // Of a disk: round of its contact before, and the peer across whose border that was.
  struct Last {
    std::uint32_t round = 0;
    int peer = none;
  };

  int peer_of(std::uint32_t disk) const;
  int peer_of(const Pair& contact) const;
  std::uint32_t earliest(std::uint32_t disk, int peer) const;
  void agree_on_rounds(std::size_t disks);
  void find_waiting(std::size_t disks);
  void begin_pass();
  void number(std::uint32_t contact);
  bool learn_rounds();
  void find_routes();
  void note_wanted(std::uint32_t contact, std::size_t at, int peer, unsigned char direction);
  void fill_routes(const std::array<Bytes, most_peers>& wanted_by_others);
  void share_out(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact,
                 const Executor& executor);
  void lay_out_phases(Patches& patches, std::uint32_t columns, const Executor& executor);
  std::array<Bytes, most_peers> exchange(const std::array<Bytes, most_peers>& out);

  template <class Values>
  void send_values(const std::array<const Route*, most_peers>& routes, Values values) {
    std::array<Bytes, most_peers> out;
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      out[p].reserve(routes[p]->send.size() * sizeof(typename Values::Value));
      for (const std::uint32_t i : routes[p]->send) put(out[p], values.get(i));
    }
    const std::array<Bytes, most_peers> in = exchange(out);
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      MessageReader reader(in[p]);
      for (const std::uint32_t i : routes[p]->receive) values.set(i, reader.get<typename Values::Value>());
    }
  }

  Ranks& ranks_;
  const GhostDisks* ghosts_ = nullptr;
  std::vector<Peer> peers_;                    // below and above; one where both are the same rank
  std::vector<Pair> contacts_;                 // the list
  std::vector<std::uint32_t> round_;           // of each
  std::vector<std::uint32_t> waiting_;         // contacts across borders, and those that have one of theirs before them
  std::vector<Last> last_;                     // of each disk
  std::vector<unsigned char> reached_border_;  // by each disk: it is in one of waiting_
  std::uint32_t rounds_ = 0;                   // across borders
  std::vector<std::uint32_t> first_phase_;     // inside, of each round, and one more
  std::vector<std::uint32_t> inside_count_;    // contacts inside, of each round
  std::vector<std::uint32_t> round_of_phase_;  // of a phase across borders, else inside
  std::vector<std::uint32_t> reached_;         // by each disk: the phase of its latest contact
  std::vector<unsigned char> counted_;         // of each patch
};

}  // namespace carom
