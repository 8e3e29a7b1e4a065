#include "parallel/slabs/shared_lists.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/load_memory.hpp"

namespace carom {

namespace {

// Disks of all ranks in a piece, in a list in order of storage: half a megabyte of a column.
constexpr std::size_t disks_a_piece = std::size_t{1} << 16;
// The least number from each rank.
constexpr std::size_t least_of_rank = 1024;

// The piece that rank 0 asks for.
struct AskedPiece {
  StateList list = StateList::x;
  std::size_t number = 0;
};

template <class Value>
Bytes bytes_of(std::span<const Value> values) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

template <class Value>
struct ById {
  DiskId id = 0;
  Value value{};
};

}  // namespace

SharedLists::SharedLists(Ranks& ranks, const State& own) : ranks_(ranks), own_(own) {
  // A rank without disks does not know the columns.
  const Disks& d = own.disks;
  std::array<double, 4> most{static_cast<double>(d.size()), d.radius.empty() ? 0.0 : 1.0, d.mass.empty() ? 0.0 : 1.0,
                             own.loads.empty() ? 0.0 : 1.0};
  ranks.maximum(most);
  auto disks = static_cast<std::int64_t>(d.size());
  ranks.sum({&disks, 1});
  columns_ = {most[1] > 0.0, most[2] > 0.0, d.spins()};
  disks_ = static_cast<Count>(disks);
  most_ = static_cast<std::size_t>(most[0]);
  any_loads_ = most[3] > 0.0;
  at_once_ = std::max(least_of_rank, disks_a_piece / static_cast<std::size_t>(ranks.count()));
}

std::size_t SharedLists::pieces(StateList list) const {
  switch (list) {
    case StateList::loads:
      return any_loads_ ? id_pieces(own_.next_id) : 0;
    case StateList::last_contact:
      return id_pieces(own_.last_contact.size());
    case StateList::thermal_hits:
      return id_pieces(own_.thermal_hits.size());
    default:
      return entries(list) > 0 ? (most_ + at_once_ - 1) / at_once_ : 0;
  }
}

Count SharedLists::entries(StateList list) const {
  switch (list) {
    case StateList::loads:
      return 0;
    case StateList::last_contact:
      return own_.last_contact.size();
    case StateList::thermal_hits:
      return own_.thermal_hits.size();
    case StateList::radius:
      return columns_.radius ? disks_ : 0;
    case StateList::mass:
      return columns_.mass ? disks_ : 0;
    case StateList::spin:
      return columns_.spin ? disks_ : 0;
    default:
      return disks_;
  }
}

Bytes SharedLists::piece(StateList list, std::size_t number) {
  Bytes asked;
  put(asked, AskedPiece{list, number});
  const auto [which, k] = MessageReader(ranks_.share(asked)).get<AskedPiece>();
  if (which == StateList::loads) return some_loads(k);
  if (which == StateList::last_contact) return some_by_id(own_.last_contact, k);
  if (which == StateList::thermal_hits) return some_by_id(own_.thermal_hits, k);
  return some_disks(which, k);
}

// A column of the next disks on each rank. A rank whose disks share their radius or mass has no such column.
Bytes SharedLists::some_disks(StateList list, std::size_t number) const {
  const Disks& d = own_.disks;
  const std::size_t begin = std::min(d.size(), number * at_once_);
  const std::size_t count = std::min(d.size() - begin, at_once_);
  Bytes here = with_list(own_, list, [&](const auto& values) {
    return values.empty() ? Bytes{} : bytes_of(std::span(values).subspan(begin, count));
  });
  if (here.empty() && count > 0) {
    const double common = list == StateList::radius ? d.common_radius : list == StateList::mass ? d.common_mass : 0.0;
    here = bytes_of(std::span<const double>(std::vector<double>(count, common)));
  }
  Bytes all;
  for (const Bytes& some : ranks_.collect(here)) all.insert(all.end(), some.begin(), some.end());
  return all;
}

// The loads of contacts whose smaller id is in the piece. Both ranks have that of a contact across a border.
Bytes SharedLists::some_loads(std::size_t number) const {
  const auto from = [&](std::size_t id) {
    return std::lower_bound(own_.loads.begin(), own_.loads.end(), id,
                            [](const ContactLoad& load, std::size_t least) { return load.id1 < least; });
  };
  Bytes here;
  put_all(here, std::vector<ContactLoad>(from(number * ids_a_piece), from((number + 1) * ids_a_piece)));
  std::vector<ContactLoad> all;
  for (const Bytes& some : ranks_.collect(here)) merge_loads(MessageReader(some).get_all<ContactLoad>(), all);
  return bytes_of(std::span<const ContactLoad>(all));
}

// Every rank has entries for all ids; only those of its own disks are right.
template <class Value>
Bytes SharedLists::some_by_id(const std::vector<Value>& values, std::size_t number) {
  if (!by_id_) by_id_.emplace(own_.disks, id_pieces(own_.next_id));
  std::vector<ById<Value>> right;
  for (const std::uint32_t i : (*by_id_)[number]) {
    const DiskId id = own_.disks.id[i];
    if (id < values.size()) right.push_back({id, values[id]});
  }
  Bytes here;
  put_all(here, right);
  const std::vector<Bytes> messages = ranks_.collect(here);
  if (ranks_.rank() > 0) return {};
  const std::size_t begin = number * ids_a_piece;
  const auto some = std::span(values).subspan(begin, std::min(ids_a_piece, values.size() - begin));
  std::vector<Value> all(some.begin(), some.end());
  for (const Bytes& message : messages) {
    for (const auto& [id, value] : MessageReader(message).get_all<ById<Value>>()) {
      if (id - begin < all.size()) all[id - begin] = value;
    }
  }
  return bytes_of(std::span<const Value>(all));
}

}  // namespace carom
