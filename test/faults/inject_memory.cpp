// SPDX-License-Identifier: BSD-3-Clause
#include "inject.h"

#include <cerrno>
#include <cstdlib>
#include <pthread.h>
#include <spawn.h>
#include <sys/mman.h>
#include <unistd.h>

/** \file Memory, processes and threads. */
using namespace pcl6d::inject;

#pragma GCC visibility push(default)
extern "C" {

// The C library's own names, behind those that are defined here.
void*
__libc_malloc(std::size_t size);
void*
__libc_calloc(std::size_t count, std::size_t size);
void*
__libc_realloc(void* old, std::size_t size);
void*
__libc_memalign(std::size_t alignment, std::size_t size);

// --- memory -------------------------------------------------------------------------

void*
mmap(void* at,
     std::size_t size,
     int protection,
     int flags,
     int file,
     off_t place) noexcept
{
  PCL6D_NEXT(mmap);
  return fails("map", ENOMEM) ? MAP_FAILED
                              : real(at, size, protection, flags, file, place);
}

void*
mmap64(void* at,
       std::size_t size,
       int protection,
       int flags,
       int file,
       off64_t place) noexcept
{
  return ::mmap(at, size, protection, flags, file, place);
}

void*
malloc(std::size_t size) noexcept
{
  return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(size);
}

void*
calloc(std::size_t count, std::size_t size) noexcept
{
  return fails("malloc", ENOMEM) ? nullptr : __libc_calloc(count, size);
}

void*
realloc(void* old, std::size_t size) noexcept
{
  return fails("malloc", ENOMEM) ? nullptr : __libc_realloc(old, size);
}

void*
memalign(std::size_t alignment, std::size_t size) noexcept
{
  return fails("malloc", ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}

void*
aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
  return ::memalign(alignment, size);
}

int
posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept
{
  void* const found = ::memalign(alignment, size);
  if (!found)
    return ENOMEM;
  *memory = found;
  return 0;
}

// --- processes and threads ----------------------------------------------------------

pid_t
fork() noexcept
{
  PCL6D_NEXT(fork);
  return fails("fork", EAGAIN) ? -1 : real();
}

pid_t
vfork() noexcept // its frame may not return twice: fork() does the same, slower
{
  return ::fork();
}

int
posix_spawn(pid_t* process,
            const char* path,
            const posix_spawn_file_actions_t* actions,
            const posix_spawnattr_t* attributes,
            char* const argv[],
            char* const environment[]) noexcept
{
  PCL6D_NEXT(posix_spawn);
  return fails("fork", EAGAIN)
             ? EAGAIN
             : real(process, path, actions, attributes, argv, environment);
}

int
posix_spawnp(pid_t* process,
             const char* file,
             const posix_spawn_file_actions_t* actions,
             const posix_spawnattr_t* attributes,
             char* const argv[],
             char* const environment[]) noexcept
{
  PCL6D_NEXT(posix_spawnp);
  return fails("fork", EAGAIN)
             ? EAGAIN
             : real(process, file, actions, attributes, argv, environment);
}

int
pthread_create(pthread_t* thread,
               const pthread_attr_t* attributes,
               void* (*body)(void*),
               void* argument) noexcept
{
  PCL6D_NEXT(pthread_create);
  return fails("thread", EAGAIN) ? EAGAIN : real(thread, attributes, body, argument);
}

} // extern "C"
#pragma GCC visibility pop
