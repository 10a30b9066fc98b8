// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace pcl6d::app {

/** \brief Blocks of memory that live in a file: their places never change, but they need not
 * be resident. The file has no name, so that nothing is left of it however the process ends.
 *
 * Room on the disk is taken before a block is handed out: a full disk is an error there, and
 * no crash later. May be used by several threads at once. */
class ScratchArena {
public:
  /** \param[in] folder where the file is made, with the first block
   * \param[in] reach [bytes] most that all blocks may have; address space alone */
  explicit ScratchArena(std::filesystem::path folder,
                        std::size_t reach = std::size_t{1} << 40);
  ~ScratchArena();
  ScratchArena(const ScratchArena&) = delete;
  ScratchArena&
  operator=(const ScratchArena&) = delete;

  /** \return a block of at least so many bytes, at a page; nullptr: the file cannot be made
   * or has no room to grow */
  void*
  allocate(std::size_t bytes);

  /** \return whether the block is one of the arena's */
  bool
  owns(const void* block) const
  {
    return block >= begin_ && block < end_;
  }

  void
  free(void* block);

  /** \brief Lets go of all pages: what is used again comes back from the file, or from the
   * system's cache of it. */
  void
  letGo();

  /** \return [bytes] of all blocks, used and freed */
  std::size_t
  size() const
  {
    return size_;
  }

private:
  using Ranges = std::map<std::size_t, std::size_t>; ///< lengths by offset

  bool
  open();
  bool
  grow(std::size_t bytes);
  void
  addFree(std::size_t offset, std::size_t length);

  const std::filesystem::path folder_;
  std::byte* begin_ = nullptr; ///< of the address space
  std::byte* end_ = nullptr;
  int file_ = -1;
  bool is_broken_ = false; ///< the file could not be made
  std::mutex mutex_;
  std::size_t size_ = 0;
  Ranges used_;
  Ranges free_;
  std::set<std::pair<std::size_t, std::size_t>> free_by_length_; ///< and offset
};

} // namespace pcl6d::app
