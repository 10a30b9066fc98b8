// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/options/settings.h"

#include <pcl6d/common/option_spec.h>

#include <functional>
#include <string>

namespace pcl6d::app {

/** Reads the word of an option to which plug-ins may add words. */
using TakeWord = void (*)(Settings&, const std::string&);

/** \return a function that reads a word into the settings, which are kept by reference */
inline std::function<void(const std::string&)>
reader(Settings& s, TakeWord take)
{
  return [&s, take](const std::string& word) { take(s, word); };
}

/** Adds the options of the input: plug-ins, folder, start, formats, recordings, motion, runs.
 * \param[in,out] settings kept by reference \param[in] slam options of the library */
void
describeInput(OptionList& list, Settings& settings, const OptionList& slam);

} // namespace pcl6d::app
