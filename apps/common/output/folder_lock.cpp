// SPDX-License-Identifier: BSD-3-Clause
#include "common/output/folder_lock.h"

#include <pcl6d/io/text.h>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace pcl6d::app {

FolderLock::FolderLock(const std::filesystem::path& folder)
{
  errno = 0;
  file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0)
    text::fail(folder, text::systemReason("cannot be opened"));
  is_held_ = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
  is_unknown_ = !is_held_ && errno != EWOULDBLOCK;
  is_held_ = is_held_ || is_unknown_;
}

FolderLock::~FolderLock()
{
  if (file_ >= 0)
    ::close(file_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
: file_(std::exchange(other.file_, -1))
, is_held_(std::exchange(other.is_held_, false))
, is_unknown_(std::exchange(other.is_unknown_, false))
{}

FolderLock&
FolderLock::operator=(FolderLock&& other) noexcept
{
  std::swap(file_, other.file_);
  std::swap(is_held_, other.is_held_);
  std::swap(is_unknown_, other.is_unknown_);
  return *this;
}

bool
FolderLock::isAt(const std::filesystem::path& path) const
{
  struct stat held {
  }, found{};
  return file_ >= 0 && ::fstat(file_, &held) == 0 &&
         ::lstat(path.c_str(), &found) == 0 && held.st_dev == found.st_dev &&
         held.st_ino == found.st_ino;
}

} // namespace pcl6d::app
