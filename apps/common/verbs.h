// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

using Arguments = std::vector<std::string>;

/** \brief A job of a program, which its first argument names. */
struct Verb {
  std::string name;
  std::string operands;                        ///< as --help shows them; may be empty
  std::string help;                            ///< what it does
  int (*run)(const Arguments& after_the_verb); ///< returns the exit code
};

/** \brief A program with several jobs. */
struct VerbProgram {
  const char* name;
  const char* usage;   ///< what follows the name; its first word stands for a verb
  const char* deed;    ///< what the verb tells: "do", "convert"
  const char* purpose; ///< one line of --help
  std::vector<Verb> verbs;
};

/** \brief The main() of a program with several jobs: runs the one that the first argument
 * names, or answers --help and --version. \return the exit code */
int
runVerbs(const VerbProgram& program, int argc, char** argv);

} // namespace pcl6d::app
