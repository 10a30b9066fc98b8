// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/option_words.h"

#include <algorithm>
#include <map>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

/** Replaces the delimiter of placeholders. */
constexpr char kPercent = '\x1f';

/** Gives access to protected members of Boost's error class. */
struct Given : po::error_with_option_name {
  static std::map<std::string, std::string>&
  in(po::error_with_option_name& error)
  {
    return error.*(&Given::m_substitutions);
  }
};
} // namespace

std::string
wordsOf(po::error& error)
{
  if (auto* const placed = dynamic_cast<po::error_with_option_name*>(&error))
    for (auto& [placeholder, text] : Given::in(*placed))
      std::replace(text.begin(), text.end(), '%', kPercent);
  std::string words = error.what();
  std::replace(words.begin(), words.end(), kPercent, '%');
  return words;
}

} // namespace pcl6d::app
