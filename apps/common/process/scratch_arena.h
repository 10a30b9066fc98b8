// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace pcl6d::app {

/** \brief Blocks of memory in a file: addresses never change, but pages need not be
 * resident. The file has no name and vanishes with the process, even a killed one.
 *
 * Room on the disk is taken before a block is handed out: a full disk is then an error,
 * not a later crash. May be used by several threads at once. */
class ScratchArena {
public:
  /** \param[in] folder folder of the file, which is made with the first block
   * \param[in] reach [bytes] upper bound of the blocks together; reserves only address space */
  explicit ScratchArena(std::filesystem::path folder,
                        std::size_t reach = std::size_t{1} << 40);
  ~ScratchArena();
  ScratchArena(const ScratchArena&) = delete;
  ScratchArena&
  operator=(const ScratchArena&) = delete;

  /** \return a page-aligned block of at least the given size [bytes]; nullptr: the file
   * cannot be made or has no room to grow */
  void*
  allocate(std::size_t bytes);

  /** \return whether the block belongs to the arena */
  bool
  owns(const void* block) const
  {
    return block >= begin_ && block < end_;
  }

  void
  free(void* block);

  /** \brief Releases the pages of the arena; used pages come back from the file or from
   * the system's cache. */
  void
  letGo();

  /** \return size of the used and freed blocks [bytes] */
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
