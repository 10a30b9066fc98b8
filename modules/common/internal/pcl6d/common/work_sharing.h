// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/packing.h>
#include <pcl6d/common/parallel.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Another rank failed, or this rank after reporting a failure: the message of the first
 * cause. */
class RankFailed : public IoFailed {
public:
  using IoFailed::IoFailed;
};

/** \brief Several processes (ranks) that run one program on equal input and share heavy loops:
 * each rank computes some items, and all ranks receive all results and continue with equal
 * state. Results are combined in the order of items, not of arrival: the bits do not depend on
 * the number of ranks.
 *
 * All calls but fail() are collective: every rank makes equal calls in equal order, from one
 * thread. If a rank fails, the call throws on every rank, and no rank waits forever.
 * \ingroup common */
class WorkSharing {
public:
  virtual ~WorkSharing();

  virtual std::size_t
  numRanks() const = 0;
  virtual std::size_t
  rank() const = 0;

  /** \return whether this rank talks to the user and writes the files */
  bool
  isFirst() const
  {
    return rank() == 0;
  }

  /** \return the rank that computes an item of a loop over scans, or a link by the later scan;
   * does not depend on the rest of the work */
  std::size_t
  ownerOf(std::size_t scan) const
  {
    return scan % numRanks();
  }
  bool
  owns(std::size_t scan) const
  {
    return ownerOf(scan) == rank();
  }

  /** The ranks that receive the bytes. */
  enum class Receivers { kAll, kFirst };

  /** \return the bytes of each rank, in rank order; empty on ranks that do not receive
   * \throws RankFailed a rank has failed */
  std::vector<std::string>
  gather(std::string mine, Receivers receivers = Receivers::kAll);

  /** \return the value of the first rank \throws RankFailed a rank has failed */
  template <typename Value>
  Value
  fromFirst(Value value)
  {
    Packer packer;
    if (isFirst())
      packer(value);
    const std::string bytes = gather(std::move(packer.bytes)).front();
    Unpacker unpacker(bytes);
    unpacker(value);
    return value;
  }

  /** \brief Joins the next collective call of the remaining ranks and makes the call throw: for
   * a rank that ends with an error. No effect after a call that threw.
   * \param[in] message for the user */
  void
  fail(const std::string& message) noexcept;

  /** \brief A loop with items computed by their owners. */
  struct Loop {
    std::size_t count = 0;
    std::function<void(std::size_t)> compute; ///< of own items, from several threads
    std::function<void(std::size_t, Packer&)> give;   ///< own items, in their order
    std::function<void(std::size_t, Unpacker&)> take; ///< unpacks another rank's item
    std::function<std::size_t(std::size_t)> owner;    ///< rank of an item
    Receivers receivers = Receivers::kAll;
  };

  /** \throws RankFailed with the message of the first item that failed on another rank; if the
   * item belongs to this rank, the exception of compute() */
  void
  run(const Loop& loop, unsigned int num_threads);

protected:
  /** \brief Contribution of a rank to a collective call. */
  struct Message {
    bool failed = false;
    std::size_t item = 0; ///< that failed
    std::string bytes;    ///< of a failed rank the error message, sent to every rank
  };

  /** \brief The collective call itself. \return the messages of all ranks, in rank order;
   * `failed` and `item` are always filled in, `bytes` on receivers only */
  virtual std::vector<Message>
  exchange(Message mine, Receivers receivers) = 0;

private:
  std::vector<std::string>
  checked(std::vector<Message> all);

  bool over_ = false; ///< a rank has failed
};

/** \brief parallelFor() over several processes: every process ends with all results.
 * \param[in] sharing null: this process computes all items
 * \param[in,out] results one element per item \param[in] owner rank of an item
 * \param[in] compute fills in results[i]; called from several threads */
template <typename Result, typename Owner, typename Compute>
void
sharedFor(WorkSharing* sharing,
          unsigned int num_threads,
          std::vector<Result>& results,
          const Owner& owner,
          const Compute& compute)
{
  if (!sharing || sharing->numRanks() == 1)
    return parallelFor(results.size(), num_threads, compute);
  WorkSharing::Loop loop;
  loop.count = results.size();
  loop.owner = [&](std::size_t i) { return sharing->ownerOf(owner(i)); };
  loop.compute = compute;
  loop.give = [&](std::size_t i, Packer& packer) { packer(results[i]); };
  loop.take = [&](std::size_t i, Unpacker& unpacker) { unpacker(results[i]); };
  sharing->run(loop, num_threads);
}

/** \brief sharedFor() if neighbouring items have similar cost. */
template <typename Result, typename Compute>
void
sharedFor(WorkSharing* sharing,
          unsigned int num_threads,
          std::vector<Result>& results,
          const Compute& compute)
{
  sharedFor(
      sharing, num_threads, results, [](std::size_t i) { return i; }, compute);
}

} // namespace pcl6d
