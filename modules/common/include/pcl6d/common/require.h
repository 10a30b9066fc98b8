// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <sstream>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Checks an option against a rule, with a uniform message.
 * \throws BadArgument "name = value, but must be rule" unless the rule is kept */
template <typename Value>
void
require(bool kept, const char* name, const Value& value, const std::string& rule)
{
  if (kept)
    return;
  std::ostringstream message;
  message << name << " = " << value << ", but must be " << rule;
  throw BadArgument(message.str());
}

} // namespace pcl6d
