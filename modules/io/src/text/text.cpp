// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <cerrno>
#include <cstring>
#include <istream>

namespace pcl6d::text {

namespace {
constexpr std::size_t kBlock = 1 << 20; // bytes read at once
constexpr std::size_t kLongestQuote = 40;
} // namespace

std::ifstream
open(const std::filesystem::path& path)
{
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (stream)
    stream.peek(); // a folder can be opened, but not read
  if (!stream && !stream.eof())
    fail(path, systemReason("cannot be opened"));
  stream.clear();
  return stream;
}

std::string
readRest(std::istream& stream, const std::filesystem::path& path)
{
  errno = 0;
  std::string content;
  while (stream) { // block by block, as a pipe does not know its size
    const std::size_t size = content.size();
    content.resize(size + kBlock);
    stream.read(content.data() + size, kBlock);
    content.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad())
    fail(path, systemReason("cannot be read"));
  return content;
}

std::string
readFile(const std::filesystem::path& path)
{
  std::ifstream stream = open(path);
  return readRest(stream, path);
}

void
fail(const std::filesystem::path& path, const std::string& message)
{
  throw IoFailed(path.string() + ": " + message);
}

void
failAt(const std::filesystem::path& path, std::size_t line, const std::string& message)
{
  fail(path, "line " + std::to_string(line) + ": " + message);
}

std::string
systemReason(const char* otherwise)
{
  return errno ? std::strerror(errno) : otherwise;
}

std::string
quoted(std::string_view token)
{
  std::string shown = "'";
  for (const char c : token.substr(0, kLongestQuote))
    shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (token.size() > kLongestQuote ? "...'" : "'");
}

std::string
counted(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

bool
isBlank(std::string_view line)
{
  return Tokens(line).next().empty();
}

void
readRow(const std::filesystem::path& path, const Lines& lines, std::vector<double>& row)
{
  row.clear();
  Tokens tokens(lines.line());
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    double value = 0;
    if (!parseNumber(token, value))
      failAt(path, lines.number(), quoted(token) + " is not a number");
    row.push_back(value);
  }
}

} // namespace pcl6d::text
