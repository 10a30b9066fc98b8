// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>

#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief An option that counts only in some runs. */
struct ConditionalOption {
  std::string name;      ///< without dashes
  bool used;             ///< whether it counts in this run
  std::string condition; ///< when it counts, such as "of the metric point"
};

/** \brief A program's options in groups, read from the command line and, with
 * `--config FILE`, from a file of `name = value` lines; the command line wins. */
class CommandLine {
public:
  /** \param[in] usage the lines above the options in --help */
  explicit CommandLine(const std::string& usage);

  /** \brief Adds a group of options, shown under its caption. */
  boost::program_options::options_description&
  group(const std::string& caption);

  /** \brief Declares the next positional argument; it is required.
   * \param[in] name as shown in errors, e.g. SCAN_DIR */
  void
  positional(const std::string& name, std::string* value);

  /** \brief Declares that all further positional arguments belong together; at least one
   * is required. */
  void
  positionals(const std::string& name, std::vector<std::string>* values);

  /** \brief Lets the value of an option bring others, which count where neither the
   * command line nor the config file gives them.
   * \param[in] lines `name = value` lines for a value of the option; what they throw goes
   * through parse() */
  void
  bringOptions(const std::string& option,
               std::function<std::string(const std::string& value)> lines);

  /** \brief Parses; on --help or --version prints it to stdout.
   * \return false when the program has nothing more to do
   * \throws UsageError, boost::program_options::error the arguments break a rule */
  bool
  parse(const std::vector<std::string>& arguments);

  /** \return whether the user gave the option (so it is no default) */
  bool
  given(const std::string& option) const;

  /** \return one sentence about the options that the user gave though they are not used
   * in this run; empty if there are none */
  std::string
  withoutEffect(const std::vector<ConditionalOption>& options) const;

private:
  boost::program_options::options_description
  allOptions() const;
  void
  readArguments(const std::vector<std::string>& arguments);
  bool
  answerQuestions() const;
  void
  readConfig(const std::string& file);
  void
  printHelp() const;

  void
  readLines(std::istream& lines, const std::string& source);

  std::string usage_;
  std::vector<std::string> captions_; ///< of the groups
  std::vector<boost::program_options::options_description> groups_;
  boost::program_options::options_description hidden_;
  boost::program_options::positional_options_description positions_;
  std::vector<std::string> positional_names_;
  std::string bringing_option_; ///< see bringOptions()
  std::function<std::string(const std::string&)> brought_lines_;
  boost::program_options::variables_map values_;
};

/** \return an option's value that defaults to what the variable holds, and shows it in
 * --help with as many digits as a person would write */
template <typename T>
boost::program_options::typed_value<T>*
valueOf(T& variable)
{
  std::ostringstream text;
  text << variable;
  return boost::program_options::value(&variable)->default_value(variable, text.str());
}

/** \brief A value that may be a number or the word "auto" (none). */
struct AutoDouble {
  bool is_auto = true;
  double value = 0;
};

std::istream&
operator>>(std::istream& stream, AutoDouble& value);
std::ostream&
operator<<(std::ostream& stream, const AutoDouble& value);

} // namespace pcl6d::app
