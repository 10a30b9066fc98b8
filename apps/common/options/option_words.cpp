// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/option_words.h"

#include <algorithm>
#include <map>
#include <utility>

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
/** \return the fewest letters to insert, delete or replace to make one word the other (V. I.
 * Levenshtein, 1966) */
std::size_t
changedLetters(const std::string& a, const std::string& b)
{
  // At k: changed letters from the part of a so far to b[0, k).
  std::vector<std::size_t> changes(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k)
    changes[k] = k;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(changes[0], i + 1);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t by_replacing = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = changes[k + 1];
      changes[k + 1] = std::min({by_replacing, diagonal + 1, changes[k] + 1});
    }
  }
  return changes.back();
}
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

std::string
nearestWord(const std::string& typed, const std::vector<std::string>& words)
{
  std::string nearest;
  std::size_t fewest = typed.size() / 3 + 1;
  for (const std::string& word : words)
    if (const std::size_t changes = changedLetters(typed, word); changes < fewest) {
      fewest = changes;
      nearest = word;
    }
  return nearest;
}

} // namespace pcl6d::app
