// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief A line of a CSV file, by the names of the columns. */
using CsvRow = std::map<std::string, std::string>;

/** \return the lines of a CSV file, by the names of the columns */
inline std::vector<CsvRow>
readCsv(const std::filesystem::path& file)
{
  std::istringstream stream(readText(file));
  std::vector<std::string> names;
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells(1);
    bool quoted = false; // a quoted cell may hold commas
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i)
      rows.back()[names[i]] = cells[i];
  }
  return rows;
}

/** \return rows without what may differ between methods that give the same result */
inline std::set<CsvRow>
without(std::vector<CsvRow> rows, const std::vector<std::string>& columns)
{
  for (CsvRow& row : rows)
    for (const auto& column : columns)
      row.erase(column);
  return {rows.begin(), rows.end()};
}

} // namespace pcl6d::test
