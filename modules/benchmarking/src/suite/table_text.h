// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** \file Cells of tables. */
namespace pcl6d::benchmarking {

/** \return a number with a fixed number of decimals */
std::string
fixedText(double value, int digits);

/** \return a cell of a Markdown table, with bars escaped */
std::string
cellOf(const std::string& text);

/** \return a field of CSV, quoted as in RFC 4180 if necessary */
std::string
csvField(const std::string& text);

} // namespace pcl6d::benchmarking
