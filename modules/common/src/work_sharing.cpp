// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/work_sharing.h>

#include <exception>
#include <limits>
#include <mutex>
#include <utility>

namespace pcl6d {

namespace {
/** Behind all items: an error without an item. */
constexpr std::size_t kNoItem = std::numeric_limits<std::size_t>::max();

/** The first item that failed, with the message. */
struct Failure {
  std::size_t item = kNoItem;
  std::string message;
  std::exception_ptr cause;
};

/** Computes items. \return the first failure in the order of items */
Failure
computeAll(const std::vector<std::size_t>& items,
           unsigned int num_threads,
           const std::function<void(std::size_t)>& compute)
{
  Failure first;
  std::mutex guard;
  const auto keep = [&](std::size_t item, const std::string& message) {
    const std::lock_guard lock(guard);
    if (item < first.item)
      first = {item, message, std::current_exception()};
  };
  parallelFor(items.size(), num_threads, [&](std::size_t k) {
    try {
      compute(items[k]);
    } catch (const std::bad_alloc&) {
      keep(items[k], "not enough memory");
    } catch (const std::exception& e) {
      keep(items[k], e.what());
    }
  });
  return first;
}
} // namespace

WorkSharing::~WorkSharing() = default;

/** \throws RankFailed a rank has failed: the first failed item counts, then the first rank */
std::vector<std::string>
WorkSharing::checked(std::vector<Message> all)
{
  const Message* cause = nullptr;
  for (const Message& one : all)
    if (one.failed && (!cause || one.item < cause->item))
      cause = &one;
  if (cause) {
    over_ = true;
    throw RankFailed(cause->bytes);
  }
  std::vector<std::string> bytes;
  for (Message& one : all)
    bytes.push_back(std::move(one.bytes));
  return bytes;
}

std::vector<std::string>
WorkSharing::gather(std::string mine, Receivers receivers)
{
  if (over_)
    throw RankFailed("another process has failed");
  Message message;
  message.bytes = std::move(mine);
  return checked(exchange(std::move(message), receivers));
}

void
WorkSharing::fail(const std::string& message) noexcept
{
  if (std::exchange(over_, true))
    return;
  try {
    exchange({true, kNoItem, message}, Receivers::kAll);
  } catch (const std::exception&) { // the rank ends anyway
  }
}

void
WorkSharing::run(const Loop& loop, unsigned int num_threads)
{
  if (over_)
    throw RankFailed("another process has failed");
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < loop.count; ++i)
    if (loop.owner(i) == rank())
      own.push_back(i);
  const Failure failure = computeAll(own, num_threads, loop.compute);
  Message mine;
  if (failure.cause) {
    mine = {true, failure.item, failure.message};
  }
  else if (loop.receivers == Receivers::kAll || !isFirst()) {
    Packer packer;
    for (const std::size_t i : own)
      loop.give(i, packer);
    mine.bytes = std::move(packer.bytes);
  }
  std::vector<std::string> all;
  try {
    all = checked(exchange(std::move(mine), loop.receivers));
  } catch (const RankFailed& e) {
    if (failure.cause && failure.message == e.what())
      std::rethrow_exception(failure.cause);
    throw;
  }
  if (loop.receivers == Receivers::kFirst && !isFirst())
    return;
  std::vector<Unpacker> unpackers(all.begin(), all.end());
  for (std::size_t i = 0; i < loop.count; ++i)
    if (loop.owner(i) != rank())
      loop.take(i, unpackers[loop.owner(i)]);
}

} // namespace pcl6d
