#include "parallel/slabs/border_contacts.hpp"

#include <algorithm>
#include <stdexcept>

namespace carom {

namespace {

// Mark of a disk that is already in the message.
constexpr std::uint8_t is_sent = 4;
// The contact count that a ghost gets before its contacts with the rank's own disks are counted.
constexpr std::uint16_t ghost_contacts = 1;

bool crosses(const GhostDisks& ghosts, const ContactEvent& e) {
  return ghosts.is_ghost(e.i1) || (!is_wall(e.id2) && ghosts.is_ghost(e.i2));
}

std::uint32_t own_disk(const GhostDisks& ghosts, const ContactEvent& e) {
  return ghosts.is_ghost(e.i1) ? e.i2 : e.i1;
}

std::uint32_t ghost_disk(const GhostDisks& ghosts, const ContactEvent& e) {
  return ghosts.is_ghost(e.i1) ? e.i1 : e.i2;
}

}  // namespace

void BorderContacts::share(State& state, DiskColumns columns, GhostDisks& ghosts, const Executor& executor,
                           ContactLists& lists) {
  alone_.clear();
  sent_.clear();
  mark_clusters(ghosts, lists);
  // With two ranks, each is the other's neighbour at both borders.
  const bool to_all = ranks_.any(any_spans(lists)) || ranks_.count() == 2;
  if (to_all) {
    const std::vector<Bytes> parts = ranks_.gather(parts_at(both_borders, state, ghosts, lists));
    for (int r = 0; r < ranks_.count(); ++r) {
      if (r != ranks_.rank()) receive(parts[static_cast<std::size_t>(r)], no_border, state, columns, ghosts);
    }
  } else {
    const Bytes down = parts_at(lower_border, state, ghosts, lists);
    const auto [below, above] = ranks_.exchange(down, parts_at(upper_border, state, ghosts, lists));
    receive(below, lower_border, state, columns, ghosts);
    receive(above, upper_border, state, columns, ghosts);
  }
  clear_marks(lists);
  lists.contacts.resize(state.disks.size(), ghost_contacts);
  merge(ghosts, executor, lists);
}

// Clusters are small, so a few passes over the contacts mark all of each.
void BorderContacts::mark_clusters(const GhostDisks& ghosts, const ContactLists& lists) {
  if (mark_.size() < ghosts.own()) mark_.resize(ghosts.own(), no_border);
  for (const ContactEvent& e : lists.crowded) {
    if (crosses(ghosts, e)) mark_[own_disk(ghosts, e)] |= ghosts.border_of(ghost_disk(ghosts, e));
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const ContactEvent& e : lists.crowded) {
      if (is_wall(e.id2) || crosses(ghosts, e) || mark_[e.i1] == mark_[e.i2]) continue;
      mark_[e.i1] = mark_[e.i2] = mark_[e.i1] | mark_[e.i2];
      changed = true;
    }
  }
}

bool BorderContacts::any_spans(const ContactLists& lists) const {
  return std::any_of(lists.crowded.begin(), lists.crowded.end(), [&](const ContactEvent& e) {
    const auto spans = [&](std::uint32_t i) { return i < mark_.size() && mark_[i] == both_borders; };
    return spans(e.i1) || (!is_wall(e.id2) && spans(e.i2));
  });
}

// Is the contact in a cluster at one of these borders?
bool BorderContacts::is_at(std::uint8_t borders, const GhostDisks& ghosts, const ContactEvent& e) const {
  return (mark_[own_disk(ghosts, e)] & borders) != 0;
}

// This rank's part of the clusters at these borders, as a message.
Bytes BorderContacts::parts_at(std::uint8_t borders, const State& state, const GhostDisks& ghosts,
                               const ContactLists& lists) {
  part_.clear();
  part_disks_.clear();
  const auto send_disk = [&](std::uint32_t i) -> std::uint16_t {
    if (ghosts.is_ghost(i)) return 0;
    if ((mark_[i] & is_sent) == 0) part_disks_.push_back(disk_at(state.disks, i));
    mark_[i] |= is_sent;
    return lists.contacts[i];
  };
  for (const ContactEvent& e : lists.crowded) {
    if (!is_at(borders, ghosts, e)) continue;
    const std::uint16_t contacts1 = send_disk(e.i1);
    part_.push_back({e.ago, e.id1, e.id2, contacts1, is_wall(e.id2) ? std::uint16_t{0} : send_disk(e.i2)});
  }
  for (const ContactEvent& e : lists.crowded) {
    const auto forget = [&](std::uint32_t i) {
      if (!ghosts.is_ghost(i)) mark_[i] &= both_borders;
    };
    forget(e.i1);
    if (!is_wall(e.id2)) forget(e.i2);
  }
  Bytes message;
  put_all(message, part_);
  put_all(message, part_disks_);
  if (state.thermal_hits.empty()) return message;
  part_hits_.clear();
  for (const Disk& disk : part_disks_) part_hits_.push_back(thermal_hits_of(state, disk.id));
  put_all(message, part_hits_);
  return message;
}

void BorderContacts::clear_marks(const ContactLists& lists) {
  for (const ContactEvent& e : lists.crowded) {
    if (e.i1 < mark_.size()) mark_[e.i1] = no_border;
    if (!is_wall(e.id2) && e.i2 < mark_.size()) mark_[e.i2] = no_border;
  }
}

void BorderContacts::receive(const Bytes& message, Border from, State& state, DiskColumns columns, GhostDisks& ghosts) {
  MessageReader reader(message);
  const auto contacts = reader.get_all<SentContact>();
  sent_.insert(sent_.end(), contacts.begin(), contacts.end());
  const auto disks = reader.get_all<Disk>();
  ghosts.add(disks, from, columns, state.disks);
  if (state.thermal_hits.empty()) return;
  const auto hits = reader.get_all<std::uint32_t>();
  for (std::size_t k = 0; k < disks.size(); ++k) take_thermal_hits(state, disks[k].id, hits.at(k));
}

// Leaves one entry for each contact, with the data of both ranks.
void BorderContacts::join_sent() {
  std::sort(sent_.begin(), sent_.end(), ids_order);
  std::size_t kept = 0;
  for (const SentContact& s : sent_) {
    if (kept > 0 && sent_[kept - 1].same_ids(s)) {
      SentContact& joined = sent_[kept - 1];
      joined.contacts1 = std::max(joined.contacts1, s.contacts1);
      joined.contacts2 = std::max(joined.contacts2, s.contacts2);
    } else {
      sent_[kept++] = s;
    }
  }
  sent_.resize(kept);
}

// Is the contact across a border, and the only one of both disks? Then it is moved to alone().
bool BorderContacts::take_alone(const GhostDisks& ghosts, const ContactLists& lists, const ContactEvent& e) {
  if (!crosses(ghosts, e)) return false;
  const auto at = std::lower_bound(sent_.begin(), sent_.end(), e, ids_order);
  if (at == sent_.end() || at->id1 != e.id1 || at->id2 != e.id2) {
    throw std::logic_error("a contact across a border was found on one side only");
  }
  const std::uint16_t of_ghost = ghosts.is_ghost(e.i1) ? at->contacts1 : at->contacts2;
  if (lists.contacts[own_disk(ghosts, e)] != 1 || of_ghost != 1) return false;
  alone_.push_back(e);
  return true;
}

void BorderContacts::merge(const GhostDisks& ghosts, const Executor& executor, ContactLists& lists) {
  join_sent();
  std::erase_if(lists.crowded, [&](const ContactEvent& e) { return take_alone(ghosts, lists, e); });
  const std::size_t here = lists.crowded.size();
  for (const SentContact& s : sent_) {
    const auto i1 = ghosts.find(s.id1);
    const auto i2 = is_wall(s.id2) ? std::optional<std::uint32_t>(0) : ghosts.find(s.id2);
    if (!i1 || !i2) continue;  // one with a disk of this rank, known already
    const bool is_alone_there = !is_wall(s.id2) && s.contacts1 == 1 && s.contacts2 == 1;
    if (!is_alone_there) lists.crowded.push_back({s.ago, s.id1, s.id2, *i1, *i2});
  }
  if (lists.crowded.size() > here) executor.sort(lists.crowded.begin(), lists.crowded.end(), event_order);
}

}  // namespace carom
