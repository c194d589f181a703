#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::cluster {

/// @addtogroup cluster
/// @{

/// Carries bytes between the ranks of a cluster, which are numbered from 0. Each rank is a process, or a
/// thread of one. Calls are made by all ranks in the same order. The ranks run the same build of graze on
/// machines of one kind, since numbers travel as they are in memory.
///
/// @par Errors
/// All calls but rank(), size() and fail() throw Error when a message cannot be sent. Between threads they
/// also throw Error when another rank has failed, or is gone. With MPI a rank that fails ends all processes.
/// A rank that leaves early has to call fail(), since the others would wait for it.
///
/// @par Threads
/// One thread at a time may use the transport of a rank.
class GRAZE_API Transport {
 public:
  /// Bytes that travel.
  using Bytes = std::vector<std::byte>;

  /// Ends the use of it by this rank.
  virtual ~Transport() = default;
  /// The number of this rank, from 0.
  [[nodiscard]] virtual int rank() const = 0;
  /// How many ranks there are, at least 1.
  [[nodiscard]] virtual int size() const = 0;
  /// Returns what each rank has given, by rank. All ranks call it.
  [[nodiscard]] virtual std::vector<Bytes> all_gather(std::span<const std::byte> given) = 0;
  /// Returns at rank 0 what each rank has given, by rank, and nothing elsewhere. All ranks call it.
  [[nodiscard]] virtual std::vector<Bytes> gather(std::span<const std::byte> given) = 0;
  /// Replaces each number by the sum of those of all ranks. All ranks give as many, and all call it.
  virtual void sum(std::span<std::uint64_t> numbers) = 0;
  /// Sends `messages[i]` to rank `ranks[i]`, and returns what each of these ranks has sent here, in the same
  /// order. `ranks` ascend, and this rank is not among them. A rank that is named here names this one as
  /// well.
  [[nodiscard]] virtual std::vector<Bytes> exchange(std::span<const int> ranks,
                                                    std::span<const Bytes> messages) = 0;
  /// Says that this rank goes no further, so that others do not wait for it. `why` is a sentence for people.
  virtual void fail(const std::string& why) noexcept = 0;

 protected:
  /// Makes the part that all transports have, which is nothing.
  Transport() = default;
  /// Copies nothing.
  Transport(const Transport&) = default;
  /// Copies nothing.
  Transport& operator=(const Transport&) = default;
};

/// Returns the transports of `size` ranks that are threads of this process. They are for tests, and for
/// programs that try out what a cluster does. Each belongs to one thread. Throws Error if `size` is below 1.
[[nodiscard]] GRAZE_API std::vector<std::shared_ptr<Transport>> thread_transports(int size);

/// @}

}  // namespace graze::cluster
