// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dlfcn.h>

namespace pcl6d::test {

/** \return whether the address sanitizer is in the process, by what it was built with or by
 * LD_PRELOAD (test/sanitize.sh --libraries): it keeps freed memory for a while, and has an
 * operator new of its own */
inline bool
isUnderAddressSanitizer()
{
  return ::dlsym(RTLD_DEFAULT, "__asan_init") != nullptr;
}

} // namespace pcl6d::test
