// Processes a list of contacts in order on several ranks, with the bits of the serial order. Contacts that share no
// disk commute exactly, so each only has to wait for the earlier ones of its own disks. Contacts of a rank's own disks
// are processed on that rank, contacts across a border on both of its sides, each of which has both disks. This is done
// in rounds: contacts inside the slabs that wait for no border; contacts across borders that wait only for these;
// inside again those that have waited for a border, and so on. Before contacts across borders, each rank sends the
// disks that the contacts of the other need and that have changed. The ranks agree on the number of rounds, which is
// small if ids are not correlated with places.
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

// All functions except counts() are collective.
class BorderRounds {
 public:
  explicit BorderRounds(Ranks& ranks);

  // Begins with the contacts of a search. crossing: those across borders, own disk first, in any order; the lists to
  // come have at most this number of contacts with ghosts.
  void begin(const std::vector<Pair>& crossing, const Disks& disks, const GhostDisks& ghosts);

  // As build_patches. A contact across a border is in the lists of both its sides, in the same order.
  template <class DisksOf>
  void build(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor, DisksOf&& disks_of) {
    resize_amply(contacts_, contacts);
    for (std::size_t k = 0; k < contacts; ++k) contacts_[k] = disks_of(k);
    agree_on_rounds(disks.size());
    share_out(patches, disks, in_contact, executor);
  }

  // Called before each phase of run_patches: if the phase is across borders, sends this rank's disks to the ranks that
  // have them as ghosts. values (disk_values.hpp): of a disk, those that the contacts change.
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

  // The same for all disks with a contact across a border.
  template <class Values>
  void refresh(Values values) {
    std::array<const Route*, most_peers> routes{};
    for (std::size_t p = 0; p < peers_.size(); ++p) routes[p] = &peers_[p].all;
    send_values(routes, values);
  }

  // Does this rank count the contacts of a patch? Those across a border are counted by the lower rank.
  bool counts(std::size_t patch) const { return counted_[patch] != 0; }

  std::uint32_t rounds() const { return rounds_; }

 private:
  static constexpr std::size_t most_peers = 2;
  static constexpr std::uint32_t inside = UINT32_MAX;
  static constexpr int none = -1;

  // Own disks whose values are sent to a rank, and ghosts whose values are received from it.
  struct Route {
    std::vector<std::uint32_t> send, receive;
  };
  // A rank that has a border with this one.
  struct Peer {
    bool counts = false;  // does it count the contacts across the border?
    Route all;
    std::vector<Route> forward, back;     // for each round of the list
    std::vector<std::uint32_t> contacts;  // those of the list that are across the border
    std::vector<std::uint32_t> known;     // of each contact: the earliest round that is possible
    std::vector<unsigned char> wanted;    // of each contact: the directions in which its own disk must be sent
    std::size_t next = 0;                 // index into contacts, in a pass
  };
  // The round of a disk's previous contact, and the peer if it was across a border.
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
  std::vector<Peer> peers_;                    // below and above; only one if both are the same rank
  std::vector<Pair> contacts_;                 // of the list
  std::vector<std::uint32_t> round_;           // of each contact
  std::vector<std::uint32_t> waiting_;         // contacts across borders, and those that come after one of them
  std::vector<Last> last_;                     // of each disk
  std::vector<unsigned char> reached_border_;  // of each disk: is it in one of waiting_?
  std::uint32_t rounds_ = 0;                   // number of rounds across borders
  std::vector<std::uint32_t> first_phase_;     // the first phase of each round inside, and the one behind the last
  std::vector<std::uint32_t> inside_count_;    // contacts inside, for each round
  std::vector<std::uint32_t> round_of_phase_;  // of each phase: its round if it is across borders, else `inside`
  std::vector<std::uint32_t> reached_;         // of each disk: the phase of its latest contact
  std::vector<unsigned char> counted_;         // of each patch: does this rank count it?
};

}  // namespace carom
