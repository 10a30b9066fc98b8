// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>

namespace pcl6d {

BadArgument::BadArgument(const std::string& message)
: pcl::BadArgumentException(message), message_(message)
{}

const char*
BadArgument::what() const noexcept
{
  return message_.c_str();
}

ComputeFailed::ComputeFailed(const std::string& message)
: pcl::ComputeFailedException(message), message_(message)
{}

const char*
ComputeFailed::what() const noexcept
{
  return message_.c_str();
}

IoFailed::IoFailed(const std::string& message)
: pcl::IOException(message), message_(message)
{}

const char*
IoFailed::what() const noexcept
{
  return message_.c_str();
}

} // namespace pcl6d
