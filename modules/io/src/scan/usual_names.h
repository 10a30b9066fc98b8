// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

namespace pcl6d::io {

/** \brief Renames fields to the usual name if only the case differs, e.g. `X`, unless the name
 * is taken. \param[in,out] fields of a point, each with a name */
template <typename Fields>
void
takeUsualNames(Fields& fields)
{
  static const std::set<std::string> usual = {
      "x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "intensity"};
  for (auto& field : fields) {
    std::string lower = field.name;
    for (char& c : lower)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto is_it = [&](const auto& other) { return other.name == lower; };
    if (usual.count(lower) > 0 && std::none_of(fields.begin(), fields.end(), is_it))
      field.name = lower;
  }
}

} // namespace pcl6d::io
