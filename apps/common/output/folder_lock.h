// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace pcl6d::app {

/** \brief Lock on a folder for one process, across machines and containers if the file
 * system supports locks. The lock ends with the process, even a killed one. */
class FolderLock {
public:
  FolderLock() = default;

  /** \brief Takes the lock. \param[in] folder an existing folder
   * \throws IoFailed the folder cannot be opened; std::system_error the reason */
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock&
  operator=(FolderLock&& other) noexcept;

  /** \return whether this process has the lock; false: another process has it */
  bool
  isHeld() const
  {
    return is_held_;
  }

  /** \return whether the file system lacks locks: another process may then use the
   * folder unnoticed */
  bool
  isUnknown() const
  {
    return is_unknown_;
  }

  /** \return whether the path still leads to the locked folder, which may have been
   * removed or replaced meanwhile */
  bool
  isAt(const std::filesystem::path& path) const;

  /** \return the descriptor of the folder; -1: not open */
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
