// SPDX-License-Identifier: BSD-3-Clause
#include "inject.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

/** \file Calls on files and folders. */
using namespace pcl6d::inject;

namespace {
bool
writes(int flags)
{
  return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
}
} // namespace

#pragma GCC visibility push(default)
extern "C" {

// --- write --------------------------------------------------------------------------

ssize_t
write(int file, const void* bytes, std::size_t size)
{
  PCL6D_NEXT(write);
  const bool hit = isOnDisk(file) && fails("write", ENOSPC);
  return hit && !shortens() ? -1 : real(file, bytes, taken(size, hit));
}

ssize_t
pwrite(int file, const void* bytes, std::size_t size, off_t place)
{
  PCL6D_NEXT(pwrite);
  const bool hit = isOnDisk(file) && fails("write", ENOSPC);
  return hit && !shortens() ? -1 : real(file, bytes, taken(size, hit), place);
}

ssize_t
pwrite64(int file, const void* bytes, std::size_t size, off64_t place)
{
  return ::pwrite(file, bytes, size, place);
}

ssize_t
writev(int file, const struct iovec* parts, int count)
{
  PCL6D_NEXT(writev);
  if (!isOnDisk(file) || !fails("write", ENOSPC))
    return real(file, parts, count);
  return shortens() ? real(file, parts, std::max(1, count / 2)) : -1;
}

std::size_t
fwrite(const void* bytes, std::size_t size, std::size_t count, FILE* file)
{
  PCL6D_NEXT(fwrite);
  const bool hit = !shortens() && isOnDisk(::fileno(file)) && fails("write", ENOSPC);
  return hit ? 0 : real(bytes, size, count, file);
}

ssize_t
sendfile(int to, int from, off_t* place, std::size_t size)
{
  PCL6D_NEXT(sendfile);
  const bool hit = isOnDisk(to) && fails("write", ENOSPC);
  return hit && !shortens() ? -1 : real(to, from, place, taken(size, hit));
}

ssize_t
copy_file_range(int from,
                off64_t* begin,
                int to,
                off64_t* place,
                std::size_t size,
                unsigned int flags)
{
  PCL6D_NEXT(copy_file_range);
  const bool hit = isOnDisk(to) && fails("write", ENOSPC);
  return hit && !shortens() ? -1
                            : real(from, begin, to, place, taken(size, hit), flags);
}

// --- read ---------------------------------------------------------------------------

ssize_t
read(int file, void* bytes, std::size_t size)
{
  PCL6D_NEXT(read);
  const bool hit = isOnDisk(file) && fails("read", EIO);
  return hit && !shortens() ? -1 : real(file, bytes, taken(size, hit));
}

std::size_t
fread(void* bytes, std::size_t size, std::size_t count, FILE* file)
{
  PCL6D_NEXT(fread);
  const bool hit = !shortens() && isOnDisk(::fileno(file)) && fails("read", EIO);
  return hit ? 0 : real(bytes, size, count, file);
}

// --- open, to write -----------------------------------------------------------------

int
open(const char* path, int flags, ...)
{
  PCL6D_NEXT(open);
  va_list rest;
  va_start(rest, flags);
  const auto rights = va_arg(rest, mode_t);
  va_end(rest);
  return writes(flags) && fails("open", ENOSPC) ? -1 : real(path, flags, rights);
}

int
open64(const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const auto rights = va_arg(rest, mode_t);
  va_end(rest);
  return ::open(path, flags, rights);
}

int
openat(int folder, const char* path, int flags, ...)
{
  PCL6D_NEXT(openat);
  va_list rest;
  va_start(rest, flags);
  const auto rights = va_arg(rest, mode_t);
  va_end(rest);
  return writes(flags) && fails("open", ENOSPC) ? -1
                                                : real(folder, path, flags, rights);
}

int
openat64(int folder, const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const auto rights = va_arg(rest, mode_t);
  va_end(rest);
  return ::openat(folder, path, flags, rights);
}

FILE*
fopen(const char* path, const char* how)
{
  PCL6D_NEXT(fopen);
  const bool to_write = std::strpbrk(how, "wa+") != nullptr;
  return to_write && fails("open", ENOSPC) ? nullptr : real(path, how);
}

FILE*
fopen64(const char* path, const char* how)
{
  return ::fopen(path, how);
}

int
mkstemp(char* name)
{
  PCL6D_NEXT(mkstemp);
  return fails("open", ENOSPC) ? -1 : real(name);
}

int
mkostemp(char* name, int flags)
{
  PCL6D_NEXT(mkostemp);
  return fails("open", ENOSPC) ? -1 : real(name, flags);
}

// --- names --------------------------------------------------------------------------

int
rename(const char* from, const char* to) noexcept
{
  PCL6D_NEXT(rename);
  return fails("rename", EACCES) ? -1 : real(from, to);
}

int
renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept
{
  PCL6D_NEXT(renameat);
  return fails("rename", EACCES) ? -1 : real(from_folder, from, to_folder, to);
}

int
renameat2(int from_folder,
          const char* from,
          int to_folder,
          const char* to,
          unsigned int flags) noexcept
{
  PCL6D_NEXT(renameat2);
  return fails("rename", EACCES) ? -1 : real(from_folder, from, to_folder, to, flags);
}

int
link(const char* from, const char* to) noexcept
{
  PCL6D_NEXT(link);
  return fails("rename", EACCES) ? -1 : real(from, to);
}

int
linkat(int from_folder,
       const char* from,
       int to_folder,
       const char* to,
       int flags) noexcept // also names what was opened without a name
{
  PCL6D_NEXT(linkat);
  return fails("rename", EACCES) ? -1 : real(from_folder, from, to_folder, to, flags);
}

int
unlink(const char* path) noexcept
{
  PCL6D_NEXT(unlink);
  return fails("unlink", EACCES) ? -1 : real(path);
}

int
unlinkat(int folder, const char* path, int flags) noexcept
{
  PCL6D_NEXT(unlinkat);
  return fails("unlink", EACCES) ? -1 : real(folder, path, flags);
}

int
rmdir(const char* path) noexcept
{
  PCL6D_NEXT(rmdir);
  return fails("unlink", EACCES) ? -1 : real(path);
}

int
mkdir(const char* path, mode_t rights) noexcept
{
  PCL6D_NEXT(mkdir);
  return fails("mkdir", ENOSPC) ? -1 : real(path, rights);
}

int
mkdirat(int folder, const char* path, mode_t rights) noexcept
{
  PCL6D_NEXT(mkdirat);
  return fails("mkdir", ENOSPC) ? -1 : real(folder, path, rights);
}

char*
mkdtemp(char* name) noexcept
{
  PCL6D_NEXT(mkdtemp);
  return fails("mkdir", ENOSPC) ? nullptr : real(name);
}

// --- files --------------------------------------------------------------------------

int
ftruncate(int file, off_t size) noexcept
{
  PCL6D_NEXT(ftruncate);
  return fails("truncate", EIO) ? -1 : real(file, size);
}

int
ftruncate64(int file, off64_t size) noexcept
{
  return ::ftruncate(file, size);
}

int
fsync(int file)
{
  PCL6D_NEXT(fsync);
  return fails("sync", EIO) ? -1 : real(file);
}

int
fdatasync(int file)
{
  PCL6D_NEXT(fdatasync);
  return fails("sync", EIO) ? -1 : real(file);
}

} // extern "C"
#pragma GCC visibility pop
