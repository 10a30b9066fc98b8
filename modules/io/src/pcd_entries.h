// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <iosfwd>
#include <map>

/** \file The lines of a PCD header. Internal to the module io. */
namespace pcl6d {

/** \brief The entries of a PCD header by their first word, before they are understood.
 */
class PcdEntries {
public:
  /** \brief Reads up to and including the line DATA. \param[in] path kept for the
   * messages \throws IoFailed unknown or repeated entry, or no DATA */
  PcdEntries(std::istream& stream, const std::filesystem::path& path);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }
  std::size_t
  numLines() const
  {
    return num_lines_;
  }
  bool
  has(std::string_view word) const
  {
    return entries_.count(word) > 0;
  }

  /** \return the values after the word \throws IoFailed there is no such entry */
  const std::vector<std::string>&
  values(std::string_view word) const;

  /** \return the same for an entry that must have so many values */
  const std::vector<std::string>&
  values(std::string_view word, std::size_t count) const;

  /** \return a value of the entry as a number */
  template <typename T>
  T
  number(std::string_view word, const std::string& token) const
  {
    T value{};
    if (!text::parseNumber(token, value))
      fail(word,
           std::string(word) + " " + text::quoted(token) + " is not " +
               (std::is_integral_v<T> ? "a whole number >= 0" : "a number"));
    return value;
  }

  /** \return the number of the line that holds the entry */
  std::size_t
  lineOf(std::string_view word) const;

  /** \throws IoFailed with the line of the entry */
  [[noreturn]] void
  fail(std::string_view word, const std::string& message) const;

private:
  struct Entry {
    std::size_t line = 0;
    std::vector<std::string> values;
  };

  bool
  readLine(std::istream& stream, std::string& line) const;
  void
  add(const std::string& line);

  std::filesystem::path path_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::size_t num_lines_ = 0;
};

} // namespace pcl6d
