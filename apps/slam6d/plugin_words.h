// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/settings.h"

#include <string>
#include <vector>

namespace pcl6d::app {

/** Files in the word of the summary, as in $PATH. */
constexpr char kPluginSeparator = ':';

/** \brief Loads the plug-ins of the command line, unless they are there.
 * \throws UsageError one cannot be used */
void
loadPlugins(Settings& settings);

/** \return the files of the plug-ins as one word, absolute; "none" */
std::string
pluginWord(const Settings& settings);

/** \return the files of such a word */
std::vector<std::string>
pluginFiles(const std::string& word);

/** \return the plug-ins and their bytes: what is computed follows from them */
std::string
pluginCondition(const Settings& settings);

/** \brief Each takes the word of an option: one of a plug-in or of the suite.
 * \throws BadArgument there is no such word; the message lists all
 * \throws UsageError a plug-in cannot be used, or the word is refused */
void
takeMinimiser(Settings& settings, const std::string& word);
void
takePlaneMinimiser(Settings& settings, const std::string& word);
void
takeSearch(Settings& settings, const std::string& word);
void
takeFilter(Settings& settings, const std::string& word);
void
takeFormat(Settings& settings, const std::string& word);

/** \return the minimisers of the suite that estimate a motion alone, without a scale */
std::vector<std::string>
minimisersOfMotion();

/** Why there is no minimiser of a scale. */
extern const char* const kOneScale;

} // namespace pcl6d::app
