// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return the text on one line, safe for a terminal: control characters (of 7 and 8
 * bits) and bytes that are not UTF-8 appear as \\n or \\x1b; a text beyond the size
 * loses its middle \param[in] size [bytes] of the text as shown, >= 100 */
std::string
printable(const std::string& text, std::size_t size = 1000);

/** \return the lines of a text, each printable(), with their line ends */
std::string
printableLines(const std::string& text);

} // namespace pcl6d::app
