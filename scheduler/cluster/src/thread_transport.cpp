#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <graze/cluster/transport.hpp>
#include <graze/error.hpp>
#include <mutex>
#include <string>
#include <utility>

namespace graze::cluster {
namespace {

using Bytes = Transport::Bytes;

/// The messages on their way between threads, for each pair of ranks in the order of sending.
class Mailboxes {
 public:
  explicit Mailboxes(int size) : size_(size), boxes_(static_cast<std::size_t>(size * size)) {}

  [[nodiscard]] int size() const { return size_; }

  void send(int from, int to, Bytes message) {
    const std::lock_guard lock(mutex_);
    box(from, to).push_back(std::move(message));
    arrived_.notify_all();
  }
  [[nodiscard]] Bytes receive(int from, int to) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [&] { return !failure_.empty() || !box(from, to).empty(); });
    if (box(from, to).empty()) throw Error(failure_);
    Bytes message = std::move(box(from, to).front());
    box(from, to).erase(box(from, to).begin());
    return message;
  }
  void fail(std::string why) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_.empty()) failure_ = std::move(why);
    arrived_.notify_all();
  }

 private:
  std::vector<Bytes>& box(int from, int to) { return boxes_[static_cast<std::size_t>(from * size_ + to)]; }

  const int size_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::vector<Bytes>> boxes_;
  std::string failure_;  ///< of the first rank that failed
};

class ThreadTransport final : public Transport {
 public:
  ThreadTransport(std::shared_ptr<Mailboxes> mailboxes, int rank)
      : mailboxes_(std::move(mailboxes)), rank_(rank) {}
  ThreadTransport(const ThreadTransport&) = delete;
  ThreadTransport& operator=(const ThreadTransport&) = delete;
  /// A rank that goes early has left the others in the lurch. Where all are done, nobody listens.
  ~ThreadTransport() override { ThreadTransport::fail("is gone"); }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return mailboxes_->size(); }

  [[nodiscard]] std::vector<Bytes> all_gather(std::span<const std::byte> given) override {
    for (int to = 0; to < size(); ++to) mailboxes_->send(rank_, to, Bytes(given.begin(), given.end()));
    std::vector<Bytes> all(static_cast<std::size_t>(size()));
    for (int from = 0; from < size(); ++from)
      all[static_cast<std::size_t>(from)] = mailboxes_->receive(from, rank_);
    return all;
  }
  [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte> given) override {
    mailboxes_->send(rank_, 0, Bytes(given.begin(), given.end()));
    std::vector<Bytes> all;
    if (rank_ != 0) return all;
    for (int from = 0; from < size(); ++from) all.push_back(mailboxes_->receive(from, 0));
    return all;
  }
  void sum(std::span<std::uint64_t> numbers) override {
    std::vector<std::uint64_t> sums(numbers.size());
    for (const Bytes& bytes : all_gather(std::as_bytes(numbers)))
      for (std::size_t i = 0; i < sums.size(); ++i) {
        std::uint64_t number = 0;
        std::memcpy(&number, bytes.data() + i * sizeof number, sizeof number);
        sums[i] += number;
      }
    std::copy(sums.begin(), sums.end(), numbers.begin());
  }
  [[nodiscard]] std::vector<Bytes> exchange(std::span<const int> ranks,
                                            std::span<const Bytes> messages) override {
    for (std::size_t i = 0; i < ranks.size(); ++i) mailboxes_->send(rank_, ranks[i], messages[i]);
    std::vector<Bytes> all;
    all.reserve(ranks.size());
    for (const int from : ranks) all.push_back(mailboxes_->receive(from, rank_));
    return all;
  }
  void fail(const std::string& why) noexcept override {
    mailboxes_->fail("rank " + std::to_string(rank_) + " " + why);
  }

 private:
  std::shared_ptr<Mailboxes> mailboxes_;
  int rank_;
};

}  // namespace

std::vector<std::shared_ptr<Transport>> thread_transports(int size) {
  if (size < 1) throw Error("a cluster has at least 1 rank, not " + std::to_string(size));
  const auto mailboxes = std::make_shared<Mailboxes>(size);
  std::vector<std::shared_ptr<Transport>> all;
  all.reserve(static_cast<std::size_t>(size));
  for (int rank = 0; rank < size; ++rank) all.push_back(std::make_shared<ThreadTransport>(mailboxes, rank));
  return all;
}

}  // namespace graze::cluster
