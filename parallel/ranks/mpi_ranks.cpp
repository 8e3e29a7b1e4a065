#include "parallel/ranks/mpi_ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/check.hpp"

namespace carom {

namespace {

// Messages upwards and downwards need different tags: with two ranks both go to the same one.
constexpr int tag_up = 1;
constexpr int tag_down = 2;
constexpr int tag_to_first = 3;
// MPI counts bytes in an int, so longer messages are sent in parts.
constexpr std::size_t longest_part = std::size_t{1} << 30;

int length_of_part(std::size_t size, std::size_t from) {
  return static_cast<int>(std::min(size - from, longest_part));
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

 private:
  FromNeighbours send_and_receive(const Bytes& to_below, const Bytes& to_above) override {
    std::vector<MPI_Request> sends;
    const std::uint64_t length_below = to_below.size();
    const std::uint64_t length_above = to_above.size();
    send(length_below, to_below, below(), tag_down, sends);
    send(length_above, to_above, above(), tag_up, sends);
    FromNeighbours from;
    from.below = receive(below(), tag_up);
    from.above = receive(above(), tag_down);
    MPI_Waitall(static_cast<int>(sends.size()), sends.data(), MPI_STATUSES_IGNORE);
    return from;
  }

  void reduce_to_sum(std::span<std::int64_t> values) override {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  }
  void reduce_to_maximum(std::span<double> values) override {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  }

  std::vector<Bytes> gather_from_all(const Bytes& here) override {
    const auto ranks = static_cast<std::size_t>(count_);
    std::vector<std::uint64_t> length(ranks);
    const std::uint64_t own = here.size();
    MPI_Allgather(&own, 1, MPI_UINT64_T, length.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    std::vector<Bytes> all(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
      if (static_cast<int>(r) == rank_) all[r] = here;
      all[r].resize(length[r]);
      for (std::size_t at = 0; at < length[r]; at += longest_part) {
        MPI_Bcast(all[r].data() + at, length_of_part(length[r], at), MPI_BYTE, static_cast<int>(r), MPI_COMM_WORLD);
      }
    }
    return all;
  }

  // The other ranks send one after the other, so that none has to hold more than its own entry.
  std::vector<Bytes> gather_at_first(const Bytes& here) override {
    if (rank_ != 0) {
      std::vector<MPI_Request> sends;
      const std::uint64_t length = here.size();
      send(length, here, 0, tag_to_first, sends);
      MPI_Waitall(static_cast<int>(sends.size()), sends.data(), MPI_STATUSES_IGNORE);
      return {};
    }
    std::vector<Bytes> all;
    all.reserve(static_cast<std::size_t>(count_));
    all.push_back(here);
    for (int r = 1; r < count_; ++r) all.push_back(receive(r, tag_to_first));
    return all;
  }

  Bytes share_first(const Bytes& first) override {
    std::uint64_t length = first.size();
    MPI_Bcast(&length, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    Bytes message = rank_ == 0 ? first : Bytes(length);
    for (std::size_t at = 0; at < length; at += longest_part) {
      MPI_Bcast(message.data() + at, length_of_part(length, at), MPI_BYTE, 0, MPI_COMM_WORLD);
    }
    return message;
  }

  // Sends the length, then the parts; messages between two ranks with one tag keep their order. length and message must
  // outlive the requests.
  static void send(const std::uint64_t& length, const Bytes& message, int to, int tag,
                   std::vector<MPI_Request>& sends) {
    MPI_Isend(&length, 1, MPI_UINT64_T, to, tag, MPI_COMM_WORLD, &sends.emplace_back());
    for (std::size_t at = 0; at < message.size(); at += longest_part) {
      MPI_Isend(message.data() + at, length_of_part(message.size(), at), MPI_BYTE, to, tag, MPI_COMM_WORLD,
                &sends.emplace_back());
    }
  }

  static Bytes receive(int from, int tag) {
    std::uint64_t length = 0;
    MPI_Recv(&length, 1, MPI_UINT64_T, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    Bytes message(length);
    for (std::size_t at = 0; at < length; at += longest_part) {
      MPI_Recv(message.data() + at, length_of_part(length, at), MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
    return message;
  }

  int rank_ = 0;
  int count_ = 1;
};

}  // namespace

// Errors of MPI itself end all processes, which is its default.
MpiSession::MpiSession() {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) throw RunError("this MPI does not allow threads (MPI_THREAD_FUNNELED)");
}

MpiSession::~MpiSession() {
  MPI_Finalize();
}

void MpiSession::abort(int status) const {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

std::unique_ptr<Ranks> MpiSession::ranks() const {
  return std::make_unique<MpiRanks>();
}

}  // namespace carom
