#include "parallel/slabs/border_rounds.hpp"

#include <algorithm>

#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// The directions in which a list is processed.
constexpr unsigned char run_forward = 1, run_back = 2;

// Contacts inside a slab are put into layouts of patches in rounds that have twice this number of contacts; in others
// there are too few for several threads.
constexpr std::size_t least_patch_contacts = 4096;

std::vector<std::uint32_t> in_id_order(std::vector<std::uint32_t> indices, const Disks& disks) {
  std::sort(indices.begin(), indices.end(),
            [&](std::uint32_t i, std::uint32_t j) { return disks.id[i] < disks.id[j]; });
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

}  // namespace

BorderRounds::BorderRounds(Ranks& ranks) : ranks_(ranks), peers_(ranks.count() == 2 ? 1 : 2) {
  // With two ranks, each is the other's only peer.
  peers_.back().counts = ranks.above() < ranks.rank();
  peers_.front().counts = ranks.below() < ranks.rank();
}

int BorderRounds::peer_of(std::uint32_t disk) const {
  if (!ghosts_->is_ghost(disk)) return none;
  return peers_.size() == 1 || ghosts_->border_of(disk) == lower_border ? 0 : 1;
}

int BorderRounds::peer_of(const Pair& contact) const {
  return std::max(peer_of(contact.i1), peer_of(contact.i2));
}

void BorderRounds::begin(const std::vector<Pair>& crossing, const Disks& disks, const GhostDisks& ghosts) {
  ghosts_ = &ghosts;
  for (Peer& peer : peers_) peer.all = {};
  for (const auto& [own, ghost] : crossing) {
    Route& route = peers_[static_cast<std::size_t>(peer_of(ghost))].all;
    route.send.push_back(own);
    route.receive.push_back(ghost);
  }
  for (Peer& peer : peers_) {
    peer.all.send = in_id_order(std::move(peer.all.send), disks);
    peer.all.receive = in_id_order(std::move(peer.all.receive), disks);
  }
}

std::array<Bytes, BorderRounds::most_peers> BorderRounds::exchange(const std::array<Bytes, most_peers>& out) {
  if (peers_.size() == 1) return {ranks_.exchange({}, out[0]).below, {}};
  auto [below, above] = ranks_.exchange(out[0], out[1]);
  return {std::move(below), std::move(above)};
}

// The first round in which the disk's next contact may be, inside (none) or across the border of a peer. Within a
// round, contacts inside come before those across borders; what one peer has changed, another learns in the next round.
std::uint32_t BorderRounds::earliest(std::uint32_t disk, int peer) const {
  const Last& last = last_[disk];
  return last.peer == none || last.peer == peer ? last.round : last.round + 1;
}

void BorderRounds::number(std::uint32_t contact) {
  const Pair& p = contacts_[contact];
  const int by = peer_of(p);
  std::uint32_t round = std::max(earliest(p.i1, by), earliest(p.i2, by));
  if (by != none) {
    Peer& peer = peers_[static_cast<std::size_t>(by)];
    std::uint32_t& known = peer.known[peer.next++];
    known = round = std::max(round, known);
  }
  round_[contact] = round;
  last_[p.i1] = last_[p.i2] = {round, by};
}

void BorderRounds::begin_pass() {
  for (const std::uint32_t k : waiting_) last_[contacts_[k].i1] = last_[contacts_[k].i2] = {};
  for (Peer& peer : peers_) peer.next = 0;
}

// Finds the contacts that wait for one across a border, and their rounds as far as this rank knows.
void BorderRounds::find_waiting(std::size_t disks) {
  waiting_.clear();
  assign_amply(round_, contacts_.size(), 0U);
  assign_amply(last_, disks, Last{});
  assign_amply(reached_border_, disks, static_cast<unsigned char>(0));
  for (Peer& peer : peers_) {
    peer.contacts.clear();
    peer.known.clear();
    peer.next = 0;
  }
  for (std::uint32_t k = 0; k < contacts_.size(); ++k) {
    const Pair& p = contacts_[k];
    const int by = peer_of(p);
    if (by == none && (reached_border_[p.i1] | reached_border_[p.i2]) == 0) continue;
    reached_border_[p.i1] = reached_border_[p.i2] = 1;
    waiting_.push_back(k);
    if (by != none) {
      peers_[static_cast<std::size_t>(by)].contacts.push_back(k);
      peers_[static_cast<std::size_t>(by)].known.push_back(0);
    }
    number(k);
  }
}

// Takes the rounds that the other side of each border has for the contacts across it. Returns whether some are later
// than this rank knew.
bool BorderRounds::learn_rounds() {
  std::array<Bytes, most_peers> out;
  for (std::size_t p = 0; p < peers_.size(); ++p) put_all(out[p], peers_[p].known);
  const std::array<Bytes, most_peers> in = exchange(out);
  bool later = false;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const auto theirs = MessageReader(in[p]).get_all<std::uint32_t>();
    std::vector<std::uint32_t>& known = peers_[p].known;
    for (std::size_t k = 0; k < known.size(); ++k) {
      later = later || theirs.at(k) > known[k];
      known[k] = std::max(known[k], theirs.at(k));
    }
  }
  return later;
}

// Rounds only grow, and none exceeds the number of contacts, so all ranks agree in the end.
void BorderRounds::agree_on_rounds(std::size_t disks) {
  find_waiting(disks);
  while (ranks_.any(learn_rounds())) {
    begin_pass();
    for (const std::uint32_t k : waiting_) number(k);
  }
  double rounds = 0.0;
  for (const Peer& peer : peers_) {
    for (const std::uint32_t round : peer.known) rounds = std::max(rounds, round + 1.0);
  }
  ranks_.maximum({&rounds, 1});
  rounds_ = static_cast<std::uint32_t>(rounds);
  find_routes();
}

// A disk must be sent before a contact across a border, unless its previous contact was across the same border: both
// sides have processed that.
void BorderRounds::note_wanted(std::uint32_t contact, std::size_t at, int peer, unsigned char direction) {
  const Pair& p = contacts_[contact];
  const std::uint32_t own = ghosts_->is_ghost(p.i1) ? p.i2 : p.i1;
  if (peer != none && last_[own].peer != peer) peers_[static_cast<std::size_t>(peer)].wanted[at] |= direction;
  last_[p.i1].peer = last_[p.i2].peer = peer;
}

void BorderRounds::find_routes() {
  for (Peer& peer : peers_) peer.wanted.assign(peer.contacts.size(), 0);
  begin_pass();
  for (const std::uint32_t k : waiting_) {
    const int by = peer_of(contacts_[k]);
    note_wanted(k, by == none ? 0 : peers_[static_cast<std::size_t>(by)].next++, by, run_forward);
  }
  begin_pass();
  for (Peer& peer : peers_) peer.next = peer.contacts.size();
  for (std::size_t n = waiting_.size(); n-- > 0;) {
    const int by = peer_of(contacts_[waiting_[n]]);
    note_wanted(waiting_[n], by == none ? 0 : --peers_[static_cast<std::size_t>(by)].next, by, run_back);
  }
  std::array<Bytes, most_peers> out;
  for (std::size_t p = 0; p < peers_.size(); ++p) put_all(out[p], peers_[p].wanted);
  fill_routes(exchange(out));
}

void BorderRounds::fill_routes(const std::array<Bytes, most_peers>& wanted_by_others) {
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    Peer& peer = peers_[p];
    const auto theirs = MessageReader(wanted_by_others[p]).get_all<unsigned char>();
    peer.forward.assign(rounds_, {});
    peer.back.assign(rounds_, {});
    for (std::size_t k = 0; k < peer.contacts.size(); ++k) {
      const Pair& pair = contacts_[peer.contacts[k]];
      const bool first_is_ghost = ghosts_->is_ghost(pair.i1);
      const std::uint32_t own = first_is_ghost ? pair.i2 : pair.i1;
      const std::uint32_t ghost = first_is_ghost ? pair.i1 : pair.i2;
      const std::uint32_t round = peer.known[k];
      if ((peer.wanted[k] & run_forward) != 0) peer.forward[round].send.push_back(own);
      if ((peer.wanted[k] & run_back) != 0) peer.back[round].send.push_back(own);
      if ((theirs.at(k) & run_forward) != 0) peer.forward[round].receive.push_back(ghost);
      if ((theirs.at(k) & run_back) != 0) peer.back[round].receive.push_back(ghost);
    }
  }
}

// columns: patches of a layout; 0 if there are no layouts.
void BorderRounds::lay_out_phases(Patches& patches, std::uint32_t columns, const Executor& executor) {
  inside_count_.assign(rounds_ + 1, 0);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (peer_of(contacts_[k]) == none) ++inside_count_[round_[k]];
  }
  patches.first.assign(1, 0);
  first_phase_.clear();
  round_of_phase_.clear();
  counted_.clear();
  const auto add_phase = [&](std::uint32_t count, std::uint32_t round) {
    patches.first.push_back(patches.first.back() + count);
    round_of_phase_.push_back(round);
    if (round == inside) counted_.resize(patches.first.back(), 1);
  };
  for (std::uint32_t round = 0; round <= rounds_; ++round) {
    first_phase_.push_back(patches.phases());
    if (columns > 0 && inside_count_[round] >= 2 * executor.grain(least_patch_contacts)) {
      for (std::uint32_t layout = 0; layout < patch_layouts; ++layout) add_phase(columns, inside);
    }
    add_phase(1, inside);
    if (round == rounds_) break;
    add_phase(static_cast<std::uint32_t>(peers_.size()), round);
    for (const Peer& peer : peers_) counted_.push_back(peer.counts ? 0 : 1);
  }
  first_phase_.push_back(patches.phases());
}

// As build_patches, in each round; across borders there is a patch for each peer. A disk has no contacts across two
// borders in one round.
void BorderRounds::share_out(Patches& patches, const Disks& disks, const std::vector<std::uint16_t>& in_contact,
                             const Executor& executor) {
  const bool in_layouts = lay_out(patches, disks, in_contact, contacts_.size(), executor);
  lay_out_phases(patches, in_layouts ? patches.first[1] : 0, executor);
  resize_amply(patches.patch, contacts_.size());
  assign_amply(reached_, disks.size(), 0U);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Pair& p = contacts_[k];
    const int by = peer_of(p);
    const std::uint32_t round = round_[k];
    const std::uint32_t first = first_phase_[round];
    const std::uint32_t last = first_phase_[round + 1] - (round < rounds_ ? 2 : 1);
    std::uint32_t phase = std::max({first, reached_[p.i1], reached_[p.i2]});
    std::uint32_t patch = 0;
    if (by != none) {
      phase = last + 1;
      patch = static_cast<std::uint32_t>(by);
    } else {
      const auto home = [&](std::uint32_t i) { return patches.home[i][phase - first]; };
      while (phase < last && home(p.i1) != home(p.i2)) ++phase;
      if (phase < last) patch = home(p.i1);
    }
    reached_[p.i1] = reached_[p.i2] = phase;
    patches.patch[k] = patches.first[phase] + patch;
  }
  order_by_patch(patches);
}

}  // namespace carom
