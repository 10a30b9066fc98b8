// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/help_text.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace {
constexpr int kMostColumns = 100; ///< wider lines are hard to read
constexpr int kFewestColumns = 60;
constexpr std::size_t kIndent = 2;

/** \return "-o, --output FILE (=map)" */
std::string
nameOf(const po::option_description& option)
{
  const std::string both = option.format_name(); // "-o [ --output ]" or "--output"
  const std::string name = "--" + option.long_name();
  const std::string parameter = option.format_parameter();
  return (both[1] == '-' ? name : both.substr(0, 2) + ", " + name) +
         (parameter.empty() ? "" : " " + parameter);
}

/** \return the words of a text, each with its trailing space; a list a|b|c longer than
 * a line is split into several words */
std::vector<std::string>
wordsOf(const std::string& text, std::size_t longest)
{
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    while (word.size() > longest) {
      const std::size_t bar = word.rfind('|', longest - 1);
      if (bar == std::string::npos)
        break;
      words.push_back(word.substr(0, bar + 1));
      word.erase(0, bar + 1);
    }
    words.push_back(word + ' ');
  }
  return words;
}

/** \return the text in lines; every line but the first is indented */
std::string
wrapped(const std::string& text, std::size_t indent, std::size_t columns)
{
  const std::size_t length = columns - indent;
  std::string lines, line;
  const auto endLine = [&] {
    line.erase(line.find_last_not_of(' ') + 1);
    lines += (lines.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
    line.clear();
  };
  for (const auto& word : wordsOf(text, length)) {
    const std::size_t seen = word.back() == ' ' ? word.size() - 1 : word.size();
    if (!line.empty() && line.size() + seen > length)
      endLine();
    line += word;
  }
  endLine();
  return lines;
}
} // namespace

int
helpColumns()
{
  winsize size{};
  if (const char* given = std::getenv("COLUMNS"))
    return std::clamp(std::atoi(given), kFewestColumns, 1 << 20);
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::clamp<int>(size.ws_col, kFewestColumns, kMostColumns);
  return kMostColumns;
}

std::string
helpLines(const po::options_description& options, int columns)
{
  const auto width = static_cast<std::size_t>(columns);
  std::size_t longest = 0;
  for (const auto& option : options.options())
    longest = std::max(longest, nameOf(*option).size());
  const std::size_t indent = kIndent + std::min(longest, width / 2 - 4) + 2;
  std::string table;
  for (const auto& option : options.options()) {
    std::string name = std::string(kIndent, ' ') + nameOf(*option);
    if (name.size() + 2 > indent)
      name += '\n' + std::string(indent, ' ');
    name.resize(std::max(name.size(), indent), ' ');
    table += name + wrapped(option->description(), indent, width) + '\n';
  }
  return table;
}

std::string
helpEnd()
{
  return "\nErrors and warnings, with cause and remedy: share/doc/messages.md\n";
}

} // namespace pcl6d::app
