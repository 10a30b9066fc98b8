// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace pcl6d::common {

/** \return the flag of the StopScope of this thread, or null. A loop sets it in the threads that
 * help. */
const std::atomic<bool>*&
stopFlag();

} // namespace pcl6d::common
