// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A job of a program. */
struct Verb {
  std::string call; ///< the word and what follows it: "info MAP"
  std::string help;
  int (*run)(const std::vector<std::string>& arguments); ///< those after the verb
};

/** \brief A program whose first argument says what to do. */
struct VerbTable {
  std::string program;
  std::string operands; ///< what the usage shows: "JOB ..."
  std::string purpose;  ///< a sentence
  std::string action;   ///< what it does with a verb: "do", "convert"
  std::size_t width;    ///< of the column of calls in --help
  std::vector<Verb> verbs;
};

/** \brief The main() of such a program; see runMain(). */
int
runVerbs(const VerbTable& table, int argc, char** argv);

} // namespace pcl6d::app
