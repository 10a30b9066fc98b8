// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <dlfcn.h>

/** \file A library for LD_PRELOAD that makes one call of a program to the system fail, so that
 * a test can try each of them in turn (inject.sh). What it does stands in the environment:
 *
 * PCL6D_INJECT_KIND   which calls: write, read, open (to write), rename (also link), unlink,
 *                     mkdir, truncate, sync, map, malloc, fork, thread; several with commas
 * PCL6D_INJECT_AT     the number of the call that fails, from 1; 0: none, they are counted
 * PCL6D_INJECT_MODE   fail (as on a full disk), from (this call and all after it), short (a
 *                     write takes half of the bytes), kill (SIGKILL in place of the call)
 * PCL6D_INJECT_COUNT  a file that then holds the number of calls, as 8 bytes
 * PCL6D_INJECT_TRACE  set: where the call came from goes to stderr, and where the program is
 *                     when a signal ends it (of a hanging one: SIGALRM)
 *
 * Only calls of the first process count, from main() on, and none of the dynamic loader. Of
 * write and read only those on regular files beyond stderr count: what a disk holds. What
 * the C library calls inside itself is out of reach, as fclose() that writes the rest. */
namespace pcl6d::inject {

/** \brief Counts a call. \return whether it is to fail; then errno is the error */
bool
fails(const char* kind, int error);

/** \return whether a call that is hit takes a part instead of failing */
bool
shortens();

/** \return how many bytes a call may take */
std::size_t
taken(std::size_t size, bool hit);

/** \return whether the file is a regular one beyond stderr */
bool
isOnDisk(int file);

/** \brief As long as it lives, calls of the thread do not count. */
class Uncounted {
public:
  Uncounted();
  ~Uncounted();
  Uncounted(const Uncounted&) = delete;
  Uncounted&
  operator=(const Uncounted&) = delete;
};

/** \return the function of that name behind this library */
template <typename Function>
Function*
next(Function*, const char* name)
{
  const Uncounted uncounted;
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

} // namespace pcl6d::inject

/** The next function of a name, looked for once. */
#define PCL6D_NEXT(name) static auto* const real = pcl6d::inject::next(&::name, #name)
