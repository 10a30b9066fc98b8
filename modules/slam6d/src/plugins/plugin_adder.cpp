// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/plugin_adder.h"
#include "plugins/plugin_guards.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/line_filter.h>

#include <algorithm>
#include <utility>

namespace pcl6d::slam6d {

namespace {
bool
isLetter(char c)
{
  return c >= 'a' && c <= 'z';
}

bool
isWord(const std::string& name)
{
  const auto fits = [](char c) {
    return isLetter(c) || (c >= '0' && c <= '9') || c == '-';
  };
  return !name.empty() && isLetter(name.front()) && name.back() != '-' &&
         std::all_of(name.begin(), name.end(), fits);
}

/** \return the words of --search, including the former "cached" */
std::vector<std::string>
searchWords()
{
  std::vector<std::string> words = searchMethodNames();
  words.emplace_back("cached");
  return words;
}
/** \return the name if --format has this word, else an empty list */
std::vector<std::string>
wordsLike(const std::string& name)
{
  try {
    scanFormatFromName(name);
    return {name};
  } catch (const BadArgument&) {
    return {};
  }
}
} // namespace

std::string
PluginAdder::who(const std::string& kind, const std::string& name) const
{
  return kind + ' ' + name + " of " + file_.string();
}

template <typename Part>
void
PluginAdder::add(const std::string& kind,
                 const std::string& name,
                 const std::vector<std::string>& own_names,
                 Part part,
                 PluginParts<Part>& parts)
{
  require(isWord(name),
          ("name of a " + kind).c_str(),
          name.empty() ? "\"\"" : name,
          "a word of small letters, digits and dashes that begins with a letter");
  if (std::find(own_names.begin(), own_names.end(), name) != own_names.end())
    throw BadArgument(kind + " " + name +
                      ": the name is taken, by a part of the program");
  if (!parts.add(name, std::move(part)))
    throw BadArgument(kind + " " + name +
                      ": the name is already taken, perhaps by another plug-in");
  description_ += (description_.empty() ? "" : ", ") + kind + ' ' + name;
}

void
PluginAdder::addMinimiser(const std::string& name, RigidMinimiser step)
{
  require(step != nullptr, "function of a minimiser", "none", "there");
  add("minimiser",
      name,
      minimiserNames(),
      guarded(who("minimiser", name), std::move(step)),
      parts_.minimisers);
}

void
PluginAdder::addPlaneMinimiser(const std::string& name, PlaneMinimiser step)
{
  require(step != nullptr, "function of a plane minimiser", "none", "there");
  add("plane minimiser",
      name,
      planeMinimiserNames(),
      guarded(who("plane minimiser", name), std::move(step)),
      parts_.plane_minimisers);
}

void
PluginAdder::addSearch(const std::string& name, SearchMaker search)
{
  require(search != nullptr, "function of a search", "none", "there");
  add("search",
      name,
      searchWords(),
      guarded(who("search", name), std::move(search)),
      parts_.searches);
}

void
PluginAdder::addFilter(const std::string& name, ScanFilter filter)
{
  require(filter != nullptr, "function of a filter", "none", "there");
  add("filter",
      name,
      lineFilterNames(),
      guarded(who("filter", name), std::move(filter)),
      parts_.filters);
}

void
PluginAdder::addReader(const std::string& name,
                       const std::string& extension,
                       ScanReader reader)
{
  require(reader != nullptr, "function of a reader", "none", "there");
  const bool fits = extension.size() > 1 && extension.front() == '.' &&
                    extension.find_first_of("./", 1) == std::string::npos;
  require(fits, "extension of a reader", extension, "a dot and further characters");
  auto format = std::make_shared<OtherScanFormat>();
  format->name = name;
  format->extension = extension;
  format->read = guarded(who("reader", name), std::move(reader));
  add<std::shared_ptr<const OtherScanFormat>>(
      "reader", name, wordsLike(name), format, parts_.formats);
}

} // namespace pcl6d::slam6d
