// SPDX-License-Identifier: BSD-3-Clause
// Options from sources beside the command line; messages name the source and the line.
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/option_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <map>
#include <sstream>
#include <string_view>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace {
/** \return the option named by a message: "--voxel = -1, but ..." */
std::string
optionIn(const std::string& message)
{
  return message.rfind("--", 0) == 0
             ? message.substr(2, message.find_first_of(" =:") - 2)
             : std::string();
}

/** \return the content of a config file \throws UsageError the file cannot be read */
std::string
configText(const std::string& file)
{
  try {
    return text::readFile(file);
  } catch (const IoFailed& e) {
    throw UsageError(std::string(e.what()) + " (config file)");
  }
}
} // namespace

void
OptionTable::readConfig(const std::string& file)
{
  const std::string content = configText(file);
  const po::options_description all = describeAll();
  std::map<std::string, std::size_t> line_of;
  for (text::Lines lines(content); lines.next();) {
    const Place place{file + ": line " + std::to_string(lines.number()), false};
    if (const auto first = lines.line().find_first_not_of(" \t");
        first != std::string_view::npos && lines.line()[first] == '[')
      throw UsageError(place.text + ": " + text::quoted(lines.line()) +
                       ", but a config file has no sections");
    std::istringstream line{std::string(lines.line())};
    try {
      const po::parsed_options parsed = po::parse_config_file(line, all);
      for (const po::option& option : parsed.options) {
        const auto [before, is_new] =
            line_of.emplace(option.string_key, lines.number());
        if (!is_new && !row(option.string_key).composing_)
          throw UsageError(place.text + ": option '" + option.string_key +
                           "' is given in line " + std::to_string(before->second) +
                           " already");
      }
      store(parsed, place);
    } catch (po::error& e) {
      throw UsageError(place.text + ": " + wordsOf(e));
    }
  }
}

void
OptionTable::readBrought(const BroughtOptions& brought)
{
  const po::options_description all = describeAll();
  for (const auto& [name, value] : brought.options) {
    const Place place{brought.source + ": option '" + name + "'", true};
    if (!all.find_nothrow(name, false))
      throw IoFailed(place.text + ": no option has this name");
    po::parsed_options parsed(&all);
    parsed.options.emplace_back(name, std::vector<std::string>{value});
    try {
      store(parsed, place);
    } catch (po::error& e) {
      throw IoFailed(place.text + ": " + wordsOf(e));
    }
  }
}

void
OptionTable::store(const po::parsed_options& options, const Place& place)
{
  for (const po::option& option : options.options)
    if (!given(option.string_key))
      places_.emplace(option.string_key, place);
  po::store(options, values_);
}

void
OptionTable::blame(const std::string& option, const std::string& message) const
{
  const auto place = places_.find(option);
  if (place == places_.end())
    throw UsageError(message);
  const std::string placed = place->second.text + ": " + message;
  if (place->second.is_data)
    throw IoFailed(placed);
  throw UsageError(placed);
}

void
OptionTable::check(const std::function<void()>& check,
                   const std::map<std::string, std::string>& words) const
try {
  checkOptions(check, words);
} catch (const UsageError& e) {
  blame(optionIn(e.what()), e.what());
}

} // namespace pcl6d::app
