// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options/options_description.hpp>

#include <string>

namespace pcl6d::app {

/** \return the width of --help [columns]: the variable COLUMNS, else the width of the
 * terminal up to 100, else 100. Generators of man pages and completions ask for very
 * wide help, where each option takes a single line. */
int
helpColumns();

/** \return a line `  -o, --output FILE  description` per option. Lines are wrapped at
 * spaces or behind the bars of a word list; continuation lines start below the
 * description, after two spaces or more */
std::string
helpLines(const boost::program_options::options_description& options, int columns);

/** \return the last line of --help: where messages of the program are explained */
std::string
helpEnd();

} // namespace pcl6d::app
