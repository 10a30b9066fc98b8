// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options/errors.hpp>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the message of an error of Boost's options. Its own what() substitutes
 * placeholders in texts of the user as well, and never ends on a text with a
 * placeholder, such as `--voxel=%value%` */
std::string
wordsOf(boost::program_options::error& error);

/** \return the word that needs the fewest changed letters, at most one in three, to become the typed
 * one; of equal ones the first; empty if none */
std::string
nearestWord(const std::string& typed, const std::vector<std::string>& words);

} // namespace pcl6d::app
