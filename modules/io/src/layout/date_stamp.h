// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

/** \file Dates with times, converted to time stamps. */
namespace pcl6d::io {

/** \return [s] since 1970 in UTC, of `YYYY-MM-DD hh:mm:ss` with any number of decimals; empty
 * for any other text */
std::optional<double>
secondsOfDate(std::string_view line);

} // namespace pcl6d::io
