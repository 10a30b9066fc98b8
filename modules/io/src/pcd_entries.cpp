// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_entries.h"

#include <algorithm>
#include <istream>

namespace pcl6d {

namespace {
constexpr std::size_t kLongestLine = 1 << 16; // [byte] longer: not a header
const char* const kWords[] = {"VERSION",
                              "FIELDS",
                              "SIZE",
                              "TYPE",
                              "COUNT",
                              "WIDTH",
                              "HEIGHT",
                              "VIEWPOINT",
                              "POINTS",
                              "DATA"};
} // namespace

PcdEntries::PcdEntries(std::istream& stream, const std::filesystem::path& path)
: path_(path)
{
  std::string line;
  while (!has("DATA")) {
    if (!readLine(stream, line))
      text::fail(path_, "the header ends without a DATA line");
    ++num_lines_;
    add(line);
  }
}

const std::vector<std::string>&
PcdEntries::values(std::string_view word) const
{
  const auto entry = entries_.find(word);
  if (entry == entries_.end())
    text::fail(path_, "the header has no " + std::string(word));
  return entry->second.values;
}

const std::vector<std::string>&
PcdEntries::values(std::string_view word, std::size_t count) const
{
  const auto& all = values(word);
  if (all.size() != count)
    fail(word,
         "expected " + text::counted(count, "value") + " after " + std::string(word) +
             ", got " + std::to_string(all.size()));
  return all;
}

std::size_t
PcdEntries::lineOf(std::string_view word) const
{
  return entries_.find(word)->second.line;
}

void
PcdEntries::fail(std::string_view word, const std::string& message) const
{
  const auto entry = entries_.find(word);
  if (entry == entries_.end())
    text::fail(path_, message);
  text::failAt(path_, entry->second.line, message);
}

bool
PcdEntries::readLine(std::istream& stream, std::string& line) const
{
  line.clear();
  char c = 0;
  while (stream.get(c) && c != '\n') {
    line += c;
    if (line.size() > kLongestLine)
      text::failAt(path_, num_lines_ + 1, "not a line of a PCD header");
  }
  return stream.good() || !line.empty(); // the last line may lack its end
}

void
PcdEntries::add(const std::string& line)
{
  text::Tokens tokens(line, "\r");
  std::string word(tokens.next());
  if (word.empty() || word.front() == '#')
    return;
  if (word == "COLUMNS") // the oldest files
    word = "FIELDS";
  if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords))
    text::failAt(
        path_, num_lines_, text::quoted(word) + " is not an entry of a PCD header");
  if (has(word))
    text::failAt(path_, num_lines_, "a second " + word);
  Entry& entry = entries_[word];
  entry.line = num_lines_;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next())
    entry.values.emplace_back(token);
}

} // namespace pcl6d
