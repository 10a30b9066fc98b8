// SPDX-License-Identifier: BSD-3-Clause
#include "stop_flag.h"

#include <pcl6d/common/interruption.h>

#include <utility>

namespace pcl6d {

const std::atomic<bool>*&
common::stopFlag()
{
  thread_local const std::atomic<bool>* flag = nullptr;
  return flag;
}

StopScope::StopScope(const std::atomic<bool>& flag)
: outer_(std::exchange(common::stopFlag(), &flag))
{}

StopScope::~StopScope()
{
  common::stopFlag() = outer_;
}

void
throwIfStopped()
{
  const std::atomic<bool>* const flag = common::stopFlag();
  if (flag != nullptr && *flag)
    throw Interrupted();
}

} // namespace pcl6d
