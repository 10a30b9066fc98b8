// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/options/settings.h"

#include <string>
#include <vector>

namespace pcl6d::app {

/** Separator of the files in the summary, like in $PATH. */
constexpr char kPluginSeparator = ':';

/** \brief Loads the plug-ins of the command line, unless already loaded.
 * \throws UsageError a plug-in cannot be used */
void
loadPlugins(Settings& settings);

/** \return the absolute files of the plug-ins as one word, or "none" */
std::string
pluginWord(const Settings& settings);

/** \return the files of a word from pluginWord() */
std::vector<std::string>
pluginFiles(const std::string& word);

/** \return the plug-ins with a hash of their content: the results depend on both */
std::string
pluginCondition(const Settings& settings);

/** \brief Each function reads the word of an option, from a plug-in or from the suite.
 * \throws BadArgument unknown word; the message lists the valid words
 * \throws UsageError a plug-in cannot be used, or the word is not allowed */
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

/** Why a minimiser with a scale is not allowed. */
extern const char* const kOneScale;

} // namespace pcl6d::app
