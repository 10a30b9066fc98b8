// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_links_io.h>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace pcl6d {

namespace {
constexpr const char* kHeader =
    "from,to,kind,verdict,reason,distance,pairs,rms,overlap,condition,weight";

/** In quotes, which a comma in a reason needs. */
std::string
inQuotes(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/** \return the cells of a row; those in double quotes may hold commas */
std::vector<std::string>
cellsOf(std::string_view row)
{
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool doubled = in_quotes && row.substr(i, 2) == "\"\"";
    if (doubled)
      cells.back() += row[++i];
    else if (row[i] == '"')
      in_quotes = !in_quotes;
    else if (row[i] == ',' && !in_quotes)
      cells.emplace_back();
    else
      cells.back() += row[i];
  }
  return cells;
}

/** The rows of a table by the names of its columns. */
class Table {
public:
  Table(const std::filesystem::path& path, std::string_view content)
  : path_(path), lines_(content)
  {
    lines_.next();
    columns_ = cellsOf(lines_.line());
  }

  bool
  next()
  {
    do {
      if (!lines_.next())
        return false;
    } while (text::isBlank(lines_.line()));
    cells_ = cellsOf(lines_.line());
    if (cells_.size() != columns_.size())
      text::failAt(path_,
                   lines_.number(),
                   "expected " + std::to_string(columns_.size()) + " columns, got " +
                       std::to_string(cells_.size()));
    return true;
  }

  const std::string&
  word(const std::string& column) const
  {
    const auto place = std::find(columns_.begin(), columns_.end(), column);
    if (place == columns_.end())
      text::failAt(path_, 1, "has no column '" + column + "'");
    return cells_[static_cast<std::size_t>(place - columns_.begin())];
  }

  template <typename Number>
  void
  take(const std::string& column, Number& number) const
  {
    if (!text::parseNumber(word(column), number))
      text::failAt(path_,
                   lines_.number(),
                   column + " = " + text::quoted(word(column)) + " is not a number");
  }

private:
  const std::filesystem::path& path_;
  text::Lines lines_;
  std::vector<std::string> columns_;
  std::vector<std::string> cells_;
};

RunLink
linkOf(const Table& table)
{
  RunLink link;
  table.take("from", link.from);
  table.take("to", link.to);
  link.kind = table.word("kind");
  link.verdict = table.word("verdict");
  link.reason = table.word("reason");
  table.take("distance", link.distance);
  table.take("pairs", link.pairs);
  table.take("rms", link.rms);
  table.take("overlap", link.overlap);
  table.take("condition", link.condition);
  table.take("weight", link.weight);
  return link;
}
} // namespace

void
writeRunLinks(const std::filesystem::path& path, const std::vector<RunLink>& links)
{
  writeFileAtomically(path, [&](std::ostream& csv) {
    csv << kHeader << '\n' << std::setprecision(6);
    for (const RunLink& link : links)
      csv << link.from << ',' << link.to << ',' << link.kind << ',' << link.verdict
          << ',' << inQuotes(link.reason) << ',' << link.distance << ',' << link.pairs
          << ',' << link.rms << ',' << link.overlap << ',' << link.condition << ','
          << link.weight << '\n';
  });
}

std::vector<RunLink>
readRunLinks(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<RunLink> links;
  for (Table table(path, content); table.next();)
    links.push_back(linkOf(table));
  return links;
}

} // namespace pcl6d
