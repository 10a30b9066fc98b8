// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

using Arguments = std::vector<std::string>;

/** \brief Verb of a program, selected by the first argument. */
struct Verb {
  std::string name;
  std::string operands;                        ///< as shown in --help; may be empty
  std::string help;                            ///< what it does
  int (*run)(const Arguments& after_the_verb); ///< returns the exit code
};

/** \brief A program with several jobs. */
struct VerbProgram {
  const char* name;
  /** text behind the program's name; its first word stands for a verb */
  const char* usage;
  const char* deed;    ///< infinitive for messages: "do", "convert"
  const char* purpose; ///< one line of --help
  std::vector<Verb> verbs;
};

/** \brief The main() of a program with several verbs: runs the verb named by the first
 * argument, or answers --help and --version. \return the exit code */
int
runVerbs(const VerbProgram& program, int argc, char** argv);

} // namespace pcl6d::app
