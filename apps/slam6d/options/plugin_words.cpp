// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "slam6d/options/plugin_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/registration/minimisers.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace pcl6d::app {

const char* const kOneScale = "scans of a run have one scale; pcl_slam6d_evaluate icp "
                              "--scale estimates the scale between two scans";

namespace {
/** \return the words of the suite, then the words of plug-ins */
template <typename Part>
std::vector<std::string>
allWords(std::vector<std::string> words, const PluginParts<Part>& parts)
{
  const std::vector<std::string> more = parts.names();
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/** \throws BadArgument unknown word; the message lists the valid words */
template <typename Part>
void
requireWord(const std::string& word,
            std::vector<std::string> own,
            const PluginParts<Part>& parts)
{
  const std::vector<std::string> words = allWords(std::move(own), parts);
  require(std::find(words.begin(), words.end(), word) != words.end(),
          "word", // checkOption() puts the name of the option here
          word,
          joined(words));
}

std::string loading; ///< the plug-in being loaded, for endWithWords()

/** Exceptions from a library's static objects cannot be caught and end the program; this handler
 * first prints a message. */
[[noreturn]] void
endWithWords()
{
  std::string what = "no std::exception";
  try {
    if (const std::exception_ptr thrown = std::current_exception())
      std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    what = e.what();
  } catch (...) {}
  std::cerr << program_invocation_short_name << ": error: --plugin: " << loading
            << ": throws while loading: " << what << " (see --help)" << std::endl;
  std::_Exit(kUsage);
}

/** Sets endWithWords() as terminate handler in its scope. */
class Loading {
public:
  explicit Loading(const std::string& file) : before_(std::set_terminate(endWithWords))
  {
    loading = file;
  }
  ~Loading() { std::set_terminate(before_); }
  Loading(const Loading&) = delete;
  Loading&
  operator=(const Loading&) = delete;

private:
  std::terminate_handler before_;
};
} // namespace

void
loadPlugins(Settings& settings)
{
  for (const std::string& file : settings.plugin_files) {
    if (file.empty() || file.find(kPluginSeparator) != std::string::npos)
      throw UsageError("--plugin = " + file + ", but must be a path without '" +
                       kPluginSeparator + "'; give the option once for each file");
    const Loading scope(file);
    try {
      settings.plugins.load(file);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      throw UsageError(std::string("--plugin: ") + e.what());
    }
  }
}

std::string
pluginWord(const Settings& settings)
{
  std::string word;
  for (const auto& plugin : settings.plugins.loaded())
    word +=
        (word.empty() ? "" : std::string(1, kPluginSeparator)) + plugin.file.string();
  return word.empty() ? "none" : word;
}

std::vector<std::string>
pluginFiles(const std::string& word)
{
  std::vector<std::string> files;
  std::istringstream stream(word);
  for (std::string file; std::getline(stream, file, kPluginSeparator);)
    files.push_back(file);
  return files;
}

std::string
pluginCondition(const Settings& settings)
{
  std::ostringstream text;
  for (const auto& plugin : settings.plugins.loaded())
    text << (text.tellp() > 0 ? " " : "") << plugin.file.string() << " (" << std::hex
         << std::setw(16) << std::setfill('0') << plugin.fingerprint << ')';
  return text.tellp() > 0 ? text.str() : "none";
}

void
takeMinimiser(Settings& settings, const std::string& word)
{
  if (word == kScaleMinimiser)
    throw BadArgument("word = " + word + ": " + kOneScale);
  loadPlugins(settings);
  const auto& parts = settings.plugins.minimisers();
  requireWord(word, minimisersOfMotion(), parts);
  const RigidMinimiser* const found = parts.find(word);
  settings.slam.minimiser = found ? *found : minimiserFromName(word);
}

void
takePlaneMinimiser(Settings& settings, const std::string& word)
{
  loadPlugins(settings);
  const auto& parts = settings.plugins.planeMinimisers();
  requireWord(word, planeMinimiserNames(), parts);
  const PlaneMinimiser* const found = parts.find(word);
  settings.slam.plane_minimiser = found ? *found : planeMinimiserFromName(word);
}

void
takeSearch(Settings& settings, const std::string& word)
{
  loadPlugins(settings);
  const auto& parts = settings.plugins.searches();
  if (const SearchMaker* const found = parts.find(word)) {
    settings.slam.make_search = *found;
    return;
  }
  try {
    settings.slam.search = searchMethodFromName(word);
  } catch (const BadArgument&) {
    requireWord(word, searchMethodNames(), parts);
    throw;
  }
}

void
takeFilter(Settings& settings, const std::string& word)
{
  loadPlugins(settings);
  const auto& parts = settings.plugins.filters();
  requireWord(word, lineFilterNames(), parts);
  if (const ScanFilter* const found = parts.find(word))
    settings.other_filter = {word, *found};
  else
    settings.filter = lineFilterFromName(word);
}

void
takeFormat(Settings& settings, const std::string& word)
{
  loadPlugins(settings);
  const auto& parts = settings.plugins.formats();
  if (const auto* const found = parts.find(word)) {
    settings.folder.other_format = *found;
    return;
  }
  try {
    settings.folder.format = scanFormatFromName(word);
  } catch (const BadArgument& e) {
    const std::vector<std::string> names = parts.names();
    throw BadArgument(e.what() + (names.empty() ? "" : ", or " + joined(names, ", ")));
  }
}

} // namespace pcl6d::app
