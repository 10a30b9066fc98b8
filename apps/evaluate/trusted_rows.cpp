// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/trusted_rows.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
std::vector<std::string>
fieldsOf(std::string_view line)
{
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}
} // namespace

std::vector<bool>
readTrustedRows(const std::string& file)
{
  const std::string content = text::readFile(file);
  text::Lines lines(content);
  if (!lines.next())
    throw IoFailed(file + ": is empty");
  const auto names = fieldsOf(lines.line());
  const auto column = std::find(names.begin(), names.end(), "trusted");
  if (column == names.end())
    throw IoFailed(file + ": line 1: has no column 'trusted'; give the mcl.csv of " +
                   "`pcl_slam6d_evaluate mcl`");
  std::vector<bool> trusted;
  while (lines.next()) {
    const auto fields = fieldsOf(lines.line());
    const std::string place = file + ": line " + std::to_string(lines.number()) + ": ";
    if (fields.size() != names.size())
      throw IoFailed(place + "expected " + std::to_string(names.size()) +
                     " fields, got " + std::to_string(fields.size()));
    const std::string& value = fields[static_cast<std::size_t>(column - names.begin())];
    if (value != "0" && value != "1")
      throw IoFailed(place + "trusted = " + text::quoted(value) +
                     ", but must be 0 or 1");
    trusted.push_back(value == "1");
  }
  if (trusted.empty())
    throw IoFailed(file + ": holds no row");
  return trusted;
}

} // namespace pcl6d::app
