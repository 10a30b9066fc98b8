// SPDX-License-Identifier: BSD-3-Clause
#include "text_table.h"

#include <fstream>
#include <stdexcept>

namespace pcl6d::faults {

namespace {
std::string
trimmed(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos
             ? ""
             : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}
} // namespace

std::vector<std::vector<std::string>>
rowsOf(const std::filesystem::path& file, std::size_t columns)
{
  std::vector<std::vector<std::string>> rows;
  std::ifstream stream(file);
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be read");
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#')
      continue;
    std::vector<std::string> row;
    std::size_t at = 0;
    while (row.size() + 1 < columns && line.find(" | ", at) != std::string::npos) {
      const std::size_t end = line.find(" | ", at);
      row.push_back(trimmed(line.substr(at, end - at)));
      at = end + 3;
    }
    row.push_back(trimmed(line.substr(at)));
    if (row.size() != columns)
      throw std::runtime_error(file.string() + ": not " + std::to_string(columns) +
                               " columns: " + line);
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::string>
separated(const std::string& text)
{
  std::vector<std::string> words;
  bool quoted = false, open = false;
  for (const char c : text) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ' ' && !quoted)
      open = false;
    else {
      if (!open)
        words.emplace_back();
      open = true;
      words.back() += c;
    }
  }
  return words;
}

void
setCall(Case& one, const std::string& inputs, const std::string& call)
{
  one.inputs = separated(inputs);
  one.arguments = separated(call);
  one.program = one.arguments.front();
  one.arguments.erase(one.arguments.begin());
}

} // namespace pcl6d::faults
