// Contacts of a step that are connected with one across a border: ranks tell each other of them, and each resolves all
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

// A cluster is a set of contacts connected through disks that they share. Clusters commute, so a rank needs only those
// with one of its own disks, but needs these completely. Neighbours send each other their parts of the clusters at
// their border. If a cluster reaches from one border of a slab to the other, which takes long rows of disks in contact
// at the same time, every rank gets all parts in that step.
class BorderContacts {
 public:
  explicit BorderContacts(Ranks& ranks) : ranks_(ranks) {}

  // lists.crowded: the contacts that are not alone on this rank, including those with ghosts, in canonical order of
  // time. Afterwards it has all contacts of their clusters, and state and ghosts have the disks of these; contacts
  // across a border that prove to be alone are in alone() instead. The contact counts of all ghosts are positive.
  void share(State& state, DiskColumns columns, GhostDisks& ghosts, const Executor& executor, ContactLists& lists);

  const std::vector<ContactEvent>& alone() const { return alone_; }

 private:
  // A contact in a message. contacts: of the disk, if the sender has it; otherwise 0.
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
  std::vector<std::uint8_t> mark_;  // of each disk in a contact: its cluster's borders; all 0 between steps
  std::vector<SentContact> sent_;   // by other ranks
  std::vector<ContactEvent> alone_;
  // Scratch.
  std::vector<SentContact> part_;
  std::vector<Disk> part_disks_;
  std::vector<std::uint32_t> part_hits_;  // by thermal sides, of these disks
};

}  // namespace carom
