// SPDX-License-Identifier: BSD-3-Clause
#include "suite/table_text.h"

#include <cstdio>

namespace pcl6d::benchmarking {

std::string
fixedText(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string
cellOf(const std::string& text)
{
  std::string cell;
  for (const char c : text)
    cell += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return cell;
}

std::string
csvField(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string field = "\"";
  for (const char c : text)
    field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

} // namespace pcl6d::benchmarking
