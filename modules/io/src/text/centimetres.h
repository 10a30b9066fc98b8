// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** \file Metres as centimetres, without a rounding that a reader could see. */
namespace pcl6d::io {

/** \brief Appends 100 times the value: the shortest text of the value with the decimal point
 * moved, equal in meaning to the value's own text. Read as double, divided by 100 and rounded
 * to float, the text gives the value back to the last bit; an input of 12.34 cm is written as
 * 12.34 again. */
void
appendCentimetres(std::string& text, float value);

/** \brief Overload for double; the text is exact, but the quotient on reading is rounded in
 * double. */
void
appendCentimetres(std::string& text, double value);

} // namespace pcl6d::io
