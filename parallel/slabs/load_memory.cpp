#include "parallel/slabs/load_memory.hpp"

#include <algorithm>
#include <cstddef>

#include "core/physics/contact_event.hpp"
#include "core/physics/event_order.hpp"
#include "parallel/ranks/message.hpp"

namespace carom {

namespace {

// Loads that a rank sends to others at a time: a megabyte.
constexpr std::size_t loads_a_piece = std::size_t{1} << 16;

bool same_contact(const ContactLoad& a, const ContactLoad& b) {
  return a.id1 == b.id1 && a.id2 == b.id2;
}

std::vector<DiskId> sorted_ids(const Disks& disks) {
  std::vector<DiskId> ids = disks.id;
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<ContactLoad> piece_of(const std::vector<ContactLoad>& loads, std::size_t begin) {
  const auto at = [&](std::size_t k) { return loads.begin() + static_cast<std::ptrdiff_t>(std::min(loads.size(), k)); };
  return {at(begin), at(begin + loads_a_piece)};
}

std::size_t most_of_ranks(Ranks& ranks, std::size_t here) {
  auto most = static_cast<double>(here);
  ranks.maximum({&most, 1});
  return static_cast<std::size_t>(most);
}

}  // namespace

std::vector<ContactLoad> loads_of(const std::vector<ContactLoad>& loads, const std::vector<DiskId>& ids) {
  std::vector<ContactLoad> theirs;
  const auto has = [&](DiskId id) { return std::binary_search(ids.begin(), ids.end(), id); };
  if (ids.empty()) return theirs;
  std::copy_if(loads.begin(), loads.end(), std::back_inserter(theirs),
               [&](const ContactLoad& load) { return has(load.id1) || (!is_wall(load.id2) && has(load.id2)); });
  return theirs;
}

void merge_loads(const std::vector<ContactLoad>& more, std::vector<ContactLoad>& loads) {
  if (more.empty()) return;
  loads.insert(loads.end(), more.begin(), more.end());
  std::sort(loads.begin(), loads.end(), ids_order);
  loads.erase(std::unique(loads.begin(), loads.end(), same_contact), loads.end());
}

void keep_own_loads(State& state) {
  if (!state.loads.empty()) state.loads = loads_of(state.loads, sorted_ids(state.disks));
}

std::vector<ContactLoad> collect_loads(Ranks& ranks, const std::vector<ContactLoad>& own) {
  std::vector<ContactLoad> all;
  const std::size_t most = most_of_ranks(ranks, own.size());
  for (std::size_t begin = 0; begin < most; begin += loads_a_piece) {
    Bytes message;
    put_all(message, piece_of(own, begin));
    for (const Bytes& piece : ranks.collect(message)) {
      const auto more = MessageReader(piece).get_all<ContactLoad>();
      all.insert(all.end(), more.begin(), more.end());
    }
  }
  std::sort(all.begin(), all.end(), ids_order);
  all.erase(std::unique(all.begin(), all.end(), same_contact), all.end());
  return all;
}

void deal_out_loads(Ranks& ranks, const std::vector<ContactLoad>& all, State& state) {
  state.loads.clear();
  const std::vector<DiskId> ids = sorted_ids(state.disks);
  const std::size_t most = most_of_ranks(ranks, all.size());
  for (std::size_t begin = 0; begin < most; begin += loads_a_piece) {
    Bytes message;
    put_all(message, piece_of(all, begin));
    const auto piece = MessageReader(ranks.share(message)).get_all<ContactLoad>();
    const std::vector<ContactLoad> own = loads_of(piece, ids);
    state.loads.insert(state.loads.end(), own.begin(), own.end());
  }
}

}  // namespace carom
