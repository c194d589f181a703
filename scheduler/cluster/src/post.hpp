#pragma once

#include <chrono>
#include <graze/cluster/settings.hpp>
#include <graze/cluster/transport.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "recording/byte_buffer.hpp"

namespace graze::cluster {

/// A transport that counts what goes through it. Stepping thread only.
class Post {
 public:
  /// Which of the counts of ClusterStatistics a message belongs to.
  using Kind = std::uint64_t ClusterStatistics::*;

  explicit Post(std::shared_ptr<Transport> transport) : transport_(std::move(transport)) {}

  [[nodiscard]] int rank() const { return transport_->rank(); }
  [[nodiscard]] int size() const { return transport_->size(); }

  [[nodiscard]] std::vector<Transport::Bytes> all_gather(Kind kind, std::span<const std::byte> given) {
    const Waiting waiting(statistics);
    count(kind, given.size() * static_cast<std::size_t>(size() - 1), static_cast<std::size_t>(size() - 1));
    return transport_->all_gather(given);
  }
  /// Writes a message for each of `ranks` by `write(rank, message)`, and returns what each of them sends.
  template <typename Write>
  [[nodiscard]] std::vector<Transport::Bytes> exchange(Kind kind, std::span<const int> ranks,
                                                       const Write& write) {
    std::vector<Transport::Bytes> messages;
    messages.reserve(ranks.size());
    for (const int rank : ranks) {
      ByteBuffer message;
      write(rank, message);
      count(kind, message.size(), 1);
      messages.emplace_back(message.bytes().begin(), message.bytes().end());
    }
    const Waiting waiting(statistics);
    return transport_->exchange(ranks, messages);
  }
  [[nodiscard]] std::vector<Transport::Bytes> gather(std::span<const std::byte> given) {
    return transport_->gather(given);
  }
  void sum(Kind kind, std::span<std::uint64_t> numbers) {
    const Waiting waiting(statistics);
    count(kind, numbers.size_bytes(), 1);
    transport_->sum(numbers);
  }
  void fail(const char* why) noexcept;

  ClusterStatistics statistics;  ///< of the current step

 private:
  /// Adds the time of its life to ClusterStatistics::wait_ms.
  class Waiting {
   public:
    explicit Waiting(ClusterStatistics& statistics) : statistics_(statistics) {}
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
    ~Waiting() {
      const auto time = std::chrono::steady_clock::now() - start_;
      statistics_.wait_ms += std::chrono::duration<double, std::milli>(time).count();
    }

   private:
    ClusterStatistics& statistics_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };
  void count(Kind kind, std::size_t bytes, std::size_t messages) {
    statistics.*kind += bytes;
    statistics.messages += messages;
  }

  std::shared_ptr<Transport> transport_;
};

}  // namespace graze::cluster
