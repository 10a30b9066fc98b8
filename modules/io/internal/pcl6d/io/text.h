// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

/** \file Fast reading and writing of text, independent of the locale, with messages that name
 * the position. */
namespace PCL6D_EXPORTS pcl6d {
namespace text {

/** \brief Opens a file for reading, without blocking; use instead of std::ifstream. A folder, a
 * pipe, a socket or a device is rejected unopened, because opening could block forever; except
 * a path of an open descriptor, such as /dev/stdin or the /dev/fd/63 of a shell's <(...).
 * \return the opened, readable file \throws IoFailed with the reason */
std::ifstream
open(const std::filesystem::path& path);

/** \return whether the name exists, including broken links; open() then reports a broken link
 * instead of a missing file */
bool
isThere(const std::filesystem::path& path);

/** \return the rest of a stream \param[in] path only for the message */
std::string
readRest(std::istream& stream, const std::filesystem::path& path);

/** \return the content of a file \throws IoFailed under the conditions of open() */
std::string
readFile(const std::filesystem::path& path);

/** \throws IoFailed "path: message" */
[[noreturn]] void
fail(const std::filesystem::path& path, const std::string& message);

/** \throws IoFailed "path: line 12: message" */
[[noreturn]] void
failAt(const std::filesystem::path& path, std::size_t line, const std::string& message);

/** \return the text of errno, or the alternative if errno is 0 */
std::string
systemReason(const char* otherwise);

/** \return the token in quotes, shortened and without control characters */
std::string
quoted(std::string_view token);

/** \return "1 point", "2 points" */
std::string
counted(std::size_t count, const std::string& noun);

/** \brief The lines of a text in order, without line ends. */
class Lines {
public:
  /** \param[in] first number of the first line, for messages */
  explicit Lines(std::string_view text, std::size_t first = 1)
  : rest_(text), number_(first - 1)
  {}

  /** \return false at the end of the text */
  bool
  next()
  {
    if (rest_.empty())
      return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line_.empty() && line_.back() == '\r')
      line_.remove_suffix(1);
    ++number_;
    return true;
  }
  std::string_view
  line() const
  {
    return line_;
  }
  std::size_t
  number() const
  {
    return number_;
  }

  /** \return the text after the line */
  std::string_view
  rest() const
  {
    return rest_;
  }

private:
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_;
};

/** \brief The tokens of a line, separated by blanks or tabs, and by optional extra separators. */
class Tokens {
public:
  explicit Tokens(std::string_view line, std::string_view extra = {})
  : rest_(line), extra_(extra)
  {}

  /** \return the next token; empty at the end of the line */
  std::string_view
  next()
  {
    std::size_t begin = 0;
    while (begin < rest_.size() && separates(rest_[begin]))
      ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !separates(rest_[end]))
      ++end;
    const std::string_view token = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return token;
  }

private:
  bool
  separates(char c) const
  {
    return c == ' ' || c == '\t' || extra_.find(c) != std::string_view::npos;
  }
  std::string_view rest_;
  std::string_view extra_;
};

/** \return whether the line holds no token */
bool
isBlank(std::string_view line);

/** \brief Parses a whole token as a number; accepts nan, inf and underflow (zero). \return false
 * if not a number, or too large */
template <typename T>
bool
parseNumber(std::string_view token, T& value)
{
  if (token.size() > 1 && token.front() == '+' && token[1] != '-')
    token.remove_prefix(1); // from_chars rejects a plus
  const char* const end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  if (result.ptr != end)
    return false;
  if constexpr (std::is_floating_point_v<T>) {
    const std::size_t exponent = token.find_first_of("eE") + 1;
    if (result.ec == std::errc::result_out_of_range && exponent > 0 &&
        token[exponent] == '-') { // too small
      value = 0;
      return true;
    }
  }
  return result.ec == std::errc();
}

/** \brief Parses all tokens of a line as numbers. \throws IoFailed naming file, line and the
 * invalid token */
void
readRow(const std::filesystem::path& path,
        const Lines& lines,
        std::vector<double>& row);

/** \brief Appends the shortest text that reads back to the same bits (for a double, up to 17
 * digits). */
template <typename T>
void
appendNumber(std::string& text, T value)
{
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, result.ptr);
}

/** \return the shortest text that reads back to the same bits */
template <typename T>
std::string
shortest(T value)
{
  std::string text;
  appendNumber(text, value);
  return text;
}

} // namespace text
} // namespace pcl6d
