// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** \file Metres as centimetres, without a rounding that a reader could see. */
namespace pcl6d::io {

/** \brief Appends 100 times the value: the shortest text of the value with its decimal
 * point moved, which says the same as the value's own text. Read as double, divided by 100
 * and rounded to float, it gives the value back to the last bit; 12.34 cm that were read
 * are written as 12.34 again. */
void
appendCentimetres(std::string& text, float value);

/** \brief The same; the text is exact, but its quotient is rounded in double. */
void
appendCentimetres(std::string& text, double value);

} // namespace pcl6d::io
