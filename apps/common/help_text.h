// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options/options_description.hpp>

#include <string>

namespace pcl6d::app {

/** \return the columns that --help may take: what the variable COLUMNS says, else those of
 * the terminal, but at most 100, else 100. Man pages and completion ask for very wide
 * help, which has each option on a line of its own. */
int
helpColumns();

/** \return a line `  -o, --output FILE  what it does` per option, wrapped at spaces, or
 * behind the bars of a list of words, with the continuation below the description; two
 * spaces or more in front of that */
std::string
helpLines(const boost::program_options::options_description& options, int columns);

} // namespace pcl6d::app
