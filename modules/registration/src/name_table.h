// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/require.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

/** \file
 * The words of the command line for the values of an enumeration. */
namespace pcl6d {

template <typename Key, std::size_t N>
using NameTable = std::array<std::pair<Key, const char*>, N>;

template <typename Key, std::size_t N>
std::vector<std::string>
namesOf(const NameTable<Key, N>& table)
{
  std::vector<std::string> names;
  for (const auto& entry : table)
    names.emplace_back(entry.second);
  return names;
}

/** \throws BadArgument no such name; the message lists all */
template <typename Key, std::size_t N>
Key
fromName(const NameTable<Key, N>& table, const char* what, const std::string& name)
{
  std::string all;
  for (const auto& entry : table) {
    if (name == entry.second)
      return entry.first;
    all += (all.empty() ? "" : "|") + std::string(entry.second);
  }
  require(false, what, name, all);
  return table.front().first;
}

template <typename Key, std::size_t N>
const char*
nameOf(const NameTable<Key, N>& table, Key key)
{
  for (const auto& entry : table)
    if (entry.first == key)
      return entry.second;
  return "unknown";
}

} // namespace pcl6d
