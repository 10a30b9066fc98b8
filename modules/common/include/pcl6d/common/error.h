// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <pcl/exceptions.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The caller's mistake: an option, a size, a null cloud. Thrown before any
 * work.
 *
 * The message names the value and the rule: `max_iterations = -1, but must be > 0`. Derives
 * from PCL's exception, so existing handlers work; what() is the message without PCL's prefix.
 * \ingroup common */
class BadArgument : public pcl::BadArgumentException {
public:
  explicit BadArgument(const std::string& message);
  const char*
  what() const noexcept override;

private:
  std::string message_;
};

/** \brief The data do not allow an answer. The message states the value found and the value
 * needed. \ingroup common */
class ComputeFailed : public pcl::ComputeFailedException {
public:
  explicit ComputeFailed(const std::string& message);
  const char*
  what() const noexcept override;

private:
  std::string message_;
};

/** \brief Reading or writing failed. The message names file, position, value and rule:
 * `scan003.pcd: line 12: expected 3 numbers, got 2`. \ingroup common */
class IoFailed : public pcl::IOException {
public:
  explicit IoFailed(const std::string& message);
  const char*
  what() const noexcept override;

private:
  std::string message_;
};

} // namespace pcl6d
