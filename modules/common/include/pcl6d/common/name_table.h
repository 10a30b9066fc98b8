// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/** \file The words for the values of an enumeration, in command lines and files. A table is an
 * array in the order of the words in messages:
 * \code
 * constexpr Named<Metric> kMetrics[] = {{Metric::kPoint, "point"}, ...};
 * \endcode */
namespace PCL6D_EXPORTS pcl6d {

template <typename Value>
struct Named {
  Value value;
  const char* name;
};

/** How a message lists the words of a table. */
enum class WordList {
  kBars,   ///< "a|b|c"
  kCommas, ///< "a, b, c"
  kOneOf,  ///< "one of a, b, c"
  kOr      ///< "a, b or c"
};

template <typename Value, std::size_t N>
std::vector<std::string>
namesOf(const Named<Value> (&table)[N])
{
  std::vector<std::string> names;
  for (const auto& entry : table)
    names.emplace_back(entry.name);
  return names;
}

template <typename Value, std::size_t N>
std::string
listed(const Named<Value> (&table)[N], WordList style)
{
  std::string words = style == WordList::kOneOf ? "one of " : "";
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0)
      words += style == WordList::kBars               ? "|"
               : style == WordList::kOr && i + 1 == N ? " or "
                                                      : ", ";
    words += table[i].name;
  }
  return words;
}

/** \return the value of a word, if known */
template <typename Value, std::size_t N>
std::optional<Value>
findNamed(const Named<Value> (&table)[N], std::string_view name)
{
  for (const auto& entry : table)
    if (name == entry.name)
      return entry.value;
  return {};
}

/** \param[in] what the option, for the message \throws BadArgument "what = name, but must be
 * ..." with the words of the table */
template <typename Value, std::size_t N>
Value
fromName(const Named<Value> (&table)[N],
         const char* what,
         const std::string& name,
         WordList style = WordList::kBars)
{
  const auto found = findNamed(table, name);
  require(found.has_value(), what, name, found ? "" : listed(table, style));
  return *found;
}

/** \return the word of a value; `otherwise` for a value without a word */
template <typename Value, std::size_t N>
constexpr const char*
nameOf(const Named<Value> (&table)[N], Value value, const char* otherwise = "unknown")
{
  for (const auto& entry : table)
    if (entry.value == value)
      return entry.name;
  return otherwise;
}

} // namespace pcl6d
