// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace pcl6d::app {

/** \brief Holds a folder for one process, whatever machine or container the others run in, as
 * far as the file system knows locks. Lost with the process, however that ends. */
class FolderLock {
public:
  FolderLock() = default;

  /** \brief Takes the lock. \param[in] folder must exist
   * \throws IoFailed it cannot be opened; std::system_error the reason */
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock&
  operator=(FolderLock&& other) noexcept;

  /** \return whether it is held; false: another process has it */
  bool
  isHeld() const
  {
    return is_held_;
  }

  /** \return whether the file system knows no locks, so that nobody can tell */
  bool
  isUnknown() const
  {
    return is_unknown_;
  }

  /** \return whether the path still leads to the folder that was locked: it may have been
   * removed or another one put in its place */
  bool
  isAt(const std::filesystem::path& path) const;

  /** \return the descriptor of the folder; -1: none */
  int
  file() const
  {
    return file_;
  }

private:
  int file_ = -1;
  bool is_held_ = false;
  bool is_unknown_ = false;
};

} // namespace pcl6d::app
