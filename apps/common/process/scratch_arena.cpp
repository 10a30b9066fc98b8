// SPDX-License-Identifier: BSD-3-Clause
#include "common/process/scratch_arena.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <iterator>
#include <string>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

namespace pcl6d::app {

namespace {
constexpr std::size_t kPage = 4096;
/** Least growth of the file [bytes]. */
constexpr std::size_t kGrowth = std::size_t{64} << 20;

std::size_t
roundUp(std::size_t bytes, std::size_t unit)
{
  return (bytes + unit - 1) / unit * unit;
}
} // namespace

ScratchArena::ScratchArena(std::filesystem::path folder, std::size_t reach)
: folder_(std::move(folder))
{
  for (; reach >= kGrowth; reach /= 2) {
    void* const space = ::mmap(
        nullptr, reach, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (space == MAP_FAILED)
      continue;
    begin_ = static_cast<std::byte*>(space);
    end_ = begin_ + reach;
    break;
  }
}

ScratchArena::~ScratchArena()
{
  if (begin_)
    ::munmap(begin_, static_cast<std::size_t>(end_ - begin_));
  if (file_ >= 0)
    ::close(file_);
}

bool
ScratchArena::open()
{
  if (file_ >= 0 || is_broken_)
    return file_ >= 0;
  const std::string path = folder_ / "scratch-XXXXXX";
  std::string name = path;
  file_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (file_ >= 0)
    ::unlink(name.c_str());
  is_broken_ = file_ < 0;
  return file_ >= 0;
}

bool
ScratchArena::grow(std::size_t bytes)
{
  const std::size_t least = roundUp(bytes, kPage);
  const auto space = static_cast<std::size_t>(end_ - begin_);
  if (size_ + least > space || !open())
    return false;
  std::size_t growth = std::min(std::max(least, kGrowth), space - size_);
  const auto takeRoom = [&] {
    int failed = EINTR;
    while (failed == EINTR)
      failed = ::posix_fallocate(
          file_, static_cast<off_t>(size_), static_cast<off_t>(growth));
    return failed == 0;
  };
  if (!takeRoom()) {
    growth = least;
    if (!takeRoom())
      return false;
  }
  if (::mmap(begin_ + size_,
             growth,
             PROT_READ | PROT_WRITE,
             MAP_SHARED | MAP_FIXED,
             file_,
             static_cast<off_t>(size_)) == MAP_FAILED)
    return false;
  addFree(size_, growth);
  size_ += growth;
  return true;
}

/** Merges the block with the free blocks before and behind it. */
void
ScratchArena::addFree(std::size_t offset, std::size_t length)
{
  const auto take = [&](Ranges::iterator range) {
    free_by_length_.erase({range->second, range->first});
    length += range->second;
    free_.erase(range);
  };
  const auto after = free_.find(offset + length);
  if (after != free_.end())
    take(after);
  const auto next = free_.lower_bound(offset);
  if (next != free_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == offset) {
      offset = before->first;
      take(before);
    }
  }
  free_.emplace(offset, length);
  free_by_length_.emplace(length, offset);
}

void*
ScratchArena::allocate(std::size_t bytes)
{
  const std::size_t length = roundUp(std::max<std::size_t>(bytes, 1), kPage);
  if (length < bytes)
    return nullptr;
  const std::lock_guard<std::mutex> lock(mutex_);
  auto place = free_by_length_.lower_bound({length, 0});
  if (place == free_by_length_.end()) {
    if (!grow(length))
      return nullptr;
    place = free_by_length_.lower_bound({length, 0});
  }
  const auto [room, offset] = *place;
  free_by_length_.erase(place);
  free_.erase(offset);
  if (room > length)
    addFree(offset + length, room - length);
  used_.emplace(offset, length);
  return begin_ + offset;
}

void
ScratchArena::free(void* block)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto used =
      used_.find(static_cast<std::size_t>(static_cast<std::byte*>(block) - begin_));
  if (used == used_.end())
    return;
  const auto [offset, length] = *used;
  used_.erase(used);
  addFree(offset, length);
}

void
ScratchArena::letGo()
{
  std::size_t size = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    size = size_;
  }
  if (size > 0)
    ::madvise(begin_, size, MADV_DONTNEED);
}

} // namespace pcl6d::app
