// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** \file Cells of tables. */
namespace pcl6d::benchmarking {

/** \return a number with as many digits behind the point */
std::string
fixedText(double value, int digits);

/** \return a cell of a Markdown table, in which a bar would end it */
std::string
cellOf(const std::string& text);

/** \return a field of CSV, quoted as in RFC 4180 where it must be */
std::string
csvField(const std::string& text);

} // namespace pcl6d::benchmarking
