// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Runs to be joined (Slam6D::addRegistered()) do not overlap, or fit in several ways.
 * \ingroup slam6d */
class GroupsApart : public ComputeFailed {
public:
  /** \param[in] group number of the run \param[in] reason in words, for people */
  GroupsApart(std::size_t group, const std::string& reason)
  : ComputeFailed("registered group " + std::to_string(group) +
                  " has no place on the first one: " + reason)
  , group_(group)
  , reason_(reason)
  {}

  /** \return the number of the group not joined to the first group */
  std::size_t
  group() const
  {
    return group_;
  }
  const std::string&
  reason() const
  {
    return reason_;
  }

private:
  std::size_t group_;
  std::string reason_;
};

} // namespace pcl6d
