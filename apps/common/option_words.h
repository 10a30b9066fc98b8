// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options/errors.hpp>

#include <string>

namespace pcl6d::app {

/** \return what an error of Boost's options says. Its own what() puts texts that the user gave into
 * others, placeholder by placeholder, and never ends where one of them holds a placeholder, as
 * `--voxel=%value%` does */
std::string
wordsOf(boost::program_options::error& error);

} // namespace pcl6d::app
