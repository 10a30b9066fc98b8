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

/** \brief Another rank could not go on, or this one after it said so: the message is that of
 * the first cause. */
class RankFailed : public IoFailed {
public:
  using IoFailed::IoFailed;
};

/** \brief Several processes (ranks) that run the same program on the same input and share its
 * heavy loops: each computes some items, and what comes out travels to all, so that all go on
 * with the same state. Results are combined in the order of items, never of arrival, so that
 * the bits do not depend on the number of ranks.
 *
 * All calls but fail() are collective: every rank makes the same ones in the same order, from
 * one thread. Where one rank fails, the call throws on all of them, so that none waits for
 * another. \ingroup common */
class WorkSharing {
public:
  virtual ~WorkSharing();

  virtual std::size_t
  numRanks() const = 0;
  virtual std::size_t
  rank() const = 0;

  /** \return whether this rank speaks with the user and writes the files */
  bool
  isFirst() const
  {
    return rank() == 0;
  }

  /** \return the rank that computes an item of a loop over scans, or a link by its later scan:
   * it stays the same whatever else there is */
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

  /** Who is to have the bytes. */
  enum class Receivers { kAll, kFirst };

  /** \return what each rank gives, in their order; nothing where it is not received
   * \throws RankFailed a rank has failed */
  std::vector<std::string>
  gather(std::string mine, Receivers receivers = Receivers::kAll);

  /** \return what the first rank gives \throws RankFailed a rank has failed */
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

  /** \brief Takes part in the next collective call of the others, and makes it throw: for a
   * rank that ends with an error of its own. Does nothing after a call that threw.
   * \param[in] message what the user is to read */
  void
  fail(const std::string& message) noexcept;

  /** \brief A loop whose items are computed by their owners. */
  struct Loop {
    std::size_t count = 0;
    std::function<void(std::size_t)> compute; ///< of own items, from several threads
    std::function<void(std::size_t, Packer&)> give;   ///< own items, in their order
    std::function<void(std::size_t, Unpacker&)> take; ///< the same items of other ranks
    std::function<std::size_t(std::size_t)> owner;    ///< rank of an item
    Receivers receivers = Receivers::kAll;
  };

  /** \throws RankFailed with the message of the first item that failed on another rank; what
   * compute() threw, where that item is of this rank */
  void
  run(const Loop& loop, unsigned int num_threads);

protected:
  /** \brief What a rank has to say. */
  struct Message {
    bool failed = false;
    std::size_t item = 0; ///< that failed
    std::string bytes;    ///< of a failed one its message, which all are to have
  };

  /** \brief The collective call itself. \return the messages of all ranks, in their order;
   * `failed` and `item` of all are there whoever receives the bytes */
  virtual std::vector<Message>
  exchange(Message mine, Receivers receivers) = 0;

private:
  std::vector<std::string>
  checked(std::vector<Message> all);

  bool over_ = false; ///< a rank has failed
};

/** \brief parallelFor() over several processes: all of them have all results in the end.
 * \param[in] sharing null: this process does all
 * \param[in,out] results one per item \param[in] owner rank of an item
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

/** \brief The same where neighbouring items take about as long. */
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
