// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::faults {

/** \return texts of numbers at and beyond the edges of what doubles, floats and whole
 * numbers hold, and texts that are nearly numbers */
inline const std::vector<std::string>&
extremeNumberTexts()
{
  static const std::vector<std::string> texts = {"0",
                                                 "-0",
                                                 "-1",
                                                 "1e-320",
                                                 "4.9e-324",
                                                 "1e-30",
                                                 "1e10",
                                                 "1e20",
                                                 "1e39",
                                                 "1e100",
                                                 "1e308",
                                                 "1e999",
                                                 "-1e999",
                                                 "inf",
                                                 "-inf",
                                                 "nan",
                                                 "-nan",
                                                 "1000000000",
                                                 "2147483647",
                                                 "2147483648",
                                                 "-2147483649",
                                                 "4294967295",
                                                 "4294967296",
                                                 "9223372036854775808",
                                                 "18446744073709551615",
                                                 "18446744073709551616",
                                                 "1e",
                                                 "0x10",
                                                 "1,5",
                                                 "--1",
                                                 "1.2.3",
                                                 "+",
                                                 "abc"};
  return texts;
}

} // namespace pcl6d::faults
