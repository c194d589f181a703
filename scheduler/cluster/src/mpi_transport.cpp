#include <mpi.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <graze/cluster/mpi.hpp>
#include <graze/error.hpp>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace graze::cluster {
namespace {

void check(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw Error(std::string(what) + ": " + std::string(text.data(), static_cast<std::size_t>(length)));
}

/// MPI counts bytes by int.
int count_of(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error("a message of " + std::to_string(bytes) + " bytes is too long for MPI");
  return static_cast<int>(bytes);
}

class MpiTransport final : public Transport {
 public:
  explicit MpiTransport(MPI_Comm given) {
    if (given == MPI_COMM_NULL) throw Error("the communicator is null");
    check(MPI_Comm_dup(given, &communicator_), "MPI_Comm_dup");
    MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN);
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &size_);
  }
  MpiTransport(const MpiTransport&) = delete;
  MpiTransport& operator=(const MpiTransport&) = delete;
  ~MpiTransport() override { MPI_Comm_free(&communicator_); }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  [[nodiscard]] std::vector<Bytes> all_gather(std::span<const std::byte> given) override {
    const int own = count_of(given.size());
    std::vector<int> counts(static_cast<std::size_t>(size_));
    check(MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator_), "MPI_Allgather");
    Bytes all;
    const std::vector<int> starts = starts_of(counts, all);
    check(MPI_Allgatherv(given.data(), own, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE,
                         communicator_),
          "MPI_Allgatherv");
    return cut(all, counts);
  }
  [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte> given) override {
    const int own = count_of(given.size());
    std::vector<int> counts(rank_ == 0 ? static_cast<std::size_t>(size_) : 0);
    check(MPI_Gather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator_), "MPI_Gather");
    Bytes all;
    const std::vector<int> starts = starts_of(counts, all);
    check(MPI_Gatherv(given.data(), own, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0,
                      communicator_),
          "MPI_Gatherv");
    return cut(all, counts);
  }
  void sum(std::span<std::uint64_t> numbers) override {
    check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), count_of(numbers.size()), MPI_UINT64_T, MPI_SUM,
                        communicator_),
          "MPI_Allreduce");
  }
  /// Messages of one rank to another arrive in the order in which they were sent. So one tag is enough.
  [[nodiscard]] std::vector<Bytes> exchange(std::span<const int> ranks,
                                            std::span<const Bytes> messages) override {
    std::vector<MPI_Request> sent(ranks.size());
    for (std::size_t i = 0; i < ranks.size(); ++i)
      check(MPI_Isend(messages[i].data(), count_of(messages[i].size()), MPI_BYTE, ranks[i], tag,
                      communicator_, &sent[i]),
            "MPI_Isend");
    std::vector<Bytes> all;
    for (const int from : ranks) {
      MPI_Message message = MPI_MESSAGE_NULL;
      MPI_Status status;
      int count = 0;
      check(MPI_Mprobe(from, tag, communicator_, &message, &status), "MPI_Mprobe");
      MPI_Get_count(&status, MPI_BYTE, &count);
      Bytes& bytes = all.emplace_back(static_cast<std::size_t>(count));
      check(MPI_Mrecv(bytes.data(), count, MPI_BYTE, &message, MPI_STATUS_IGNORE), "MPI_Mrecv");
    }
    check(MPI_Waitall(static_cast<int>(sent.size()), sent.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    return all;
  }
  void fail(const std::string& why) noexcept override {
    std::fprintf(stderr, "graze: rank %d of %d %s\n", rank_, size_, why.c_str());
    std::fflush(stderr);
    MPI_Abort(communicator_, 1);
  }

 private:
  static constexpr int tag = 1;

  /// Makes room for the bytes of all ranks, and returns where those of each begin.
  static std::vector<int> starts_of(const std::vector<int>& counts, Bytes& all) {
    std::vector<int> starts;
    std::size_t end = 0;
    for (const int count : counts) {
      starts.push_back(count_of(end));
      end += static_cast<std::size_t>(count);
    }
    all.resize(end);
    return starts;
  }
  static std::vector<Bytes> cut(const Bytes& all, const std::vector<int>& counts) {
    std::vector<Bytes> parts;
    auto at = all.begin();
    for (const int count : counts) {
      parts.emplace_back(at, at + count);
      at += count;
    }
    return parts;
  }

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace

std::shared_ptr<Transport> mpi_transport(MPI_Comm communicator) {
  return std::make_shared<MpiTransport>(communicator);
}

}  // namespace graze::cluster
