// Contacts of a step that hang together with one across a border: ranks tell each other of them, and each resolves all
// that concern it, in the canonical order, with the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/state.hpp"
#include "core/physics/contact_event.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/ghost_disks.hpp"
#include "parallel/stepping/resolve_contacts.hpp"

namespace carom {

// A cluster is a set of contacts in which one leads to the next through a disk that both have. Clusters commute, so a
// rank needs those that have one of its own disks, as a whole. Neighbours send each other their parts of the clusters
// at their border. Where a cluster reaches from one border of a slab to the other, which takes long rows of disks in
// contact at once, every rank gets all parts for that step.
class BorderContacts {
 public:
  explicit BorderContacts(Ranks& ranks) : ranks_(ranks) {}

  // lists.crowded: the contacts that are not alone here, those with ghosts among them, in canonical order of time.
  // Afterwards it has all contacts of their clusters, and state and ghosts have the disks of those; contacts across a
  // border that turn out to be alone are in alone() instead. Of all ghosts the contact count is positive.
  void share(State& state, DiskColumns columns, GhostDisks& ghosts, const Executor& executor, ContactLists& lists);

  const std::vector<ContactEvent>& alone() const { return alone_; }

 private:
  // A contact as it is sent. contacts: of the disk, where the sender has it; else 0.
  struct SentContact {
    double ago;
    DiskId id1, id2;
    std::uint16_t contacts1, contacts2;
    bool same_ids(const SentContact& other) const { return id1 == other.id1 && id2 == other.id2; }
  };

  void mark_clusters(const GhostDisks& ghosts, const ContactLists& lists);
  bool any_spans(const ContactLists& lists) const;
  bool is_at(std::uint8_t borders, const GhostDisks& ghosts, const ContactEvent& e) const;
  Bytes parts_at(std::uint8_t borders, const State& state, const GhostDisks& ghosts, const ContactLists& lists);
  void clear_marks(const ContactLists& lists);
  void receive(const Bytes& message, Border from, State& state, DiskColumns columns, GhostDisks& ghosts);
  void merge(const GhostDisks& ghosts, const Executor& executor, ContactLists& lists);
  void join_sent();
  bool take_alone(const GhostDisks& ghosts, const ContactLists& lists, const ContactEvent& e);

  Ranks& ranks_;
  std::vector<std::uint8_t> mark_;  // of each disk in a contact: at which borders its cluster is; all 0 between steps
  std::vector<SentContact> sent_;   // by others
  std::vector<ContactEvent> alone_;
  // Scratch.
  std::vector<SentContact> part_;
  std::vector<Disk> part_disks_;
  std::vector<std::uint32_t> part_hits_;  // by thermal sides, of these disks
};

}  // namespace carom
