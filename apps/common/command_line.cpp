// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "common/help_text.h"

#include <pcl6d/common/version.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace po = boost::program_options;

namespace pcl6d::app {

CommandLine::CommandLine(const std::string& usage) : usage_(usage)
{
  groups_.reserve(16); // group() hands out references
}

po::options_description&
CommandLine::group(const std::string& caption)
{
  captions_.push_back(caption);
  return groups_.emplace_back();
}

void
CommandLine::positional(const std::string& name, std::string* value)
{
  hidden_.add_options()(name.c_str(), po::value(value));
  positions_.add(name.c_str(), 1);
  positional_names_.push_back(name);
}

void
CommandLine::positionals(const std::string& name, std::vector<std::string>* values)
{
  hidden_.add_options()(name.c_str(), po::value(values));
  positions_.add(name.c_str(), -1);
  positional_names_.push_back(name);
}

void
CommandLine::printHelp() const
{
  const int columns = helpColumns();
  std::cout << usage_;
  for (std::size_t i = 0; i < groups_.size(); ++i)
    std::cout << '\n' << captions_[i] << ":\n" << optionTable(groups_[i], columns);
}

void
CommandLine::readConfig(const std::string& file)
{
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw UsageError(file + ": cannot read config file");
  readLines(stream, file);
}

void
CommandLine::readLines(std::istream& lines, const std::string& source)
{
  po::options_description all;
  for (const auto& group : groups_)
    if (group.options().front()->long_name() != "config") // these have no sense in it
      all.add(group);
  try {
    po::store(po::parse_config_file(lines, all), values_);
  } catch (const po::error& e) {
    throw UsageError(source + ": " + e.what());
  }
}

void
CommandLine::bringOptions(const std::string& option,
                          std::function<std::string(const std::string&)> lines)
{
  bringing_option_ = option;
  brought_lines_ = std::move(lines);
}

po::options_description
CommandLine::allOptions() const
{
  po::options_description all;
  for (const auto& group : groups_)
    all.add(group);
  all.add(hidden_);
  return all;
}

void
CommandLine::readArguments(const std::vector<std::string>& arguments)
{
  using Style = po::command_line_style::style_t;
  const po::options_description all = allOptions();
  try {
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(positions_)
                  .style(po::command_line_style::unix_style ^ Style::allow_guessing)
                  .run(),
              values_);
  } catch (const po::too_many_positional_options_error&) {
    std::string wanted;
    for (const auto& name : positional_names_)
      wanted += " " + name;
    throw UsageError("too many arguments; expected" + wanted +
                     ", and everything else with the name of its option");
  }
}

/** Prints the help or the version if asked to. \return whether it was */
bool
CommandLine::answerQuestions() const
{
  if (values_.count("help")) {
    printHelp();
    return true;
  }
  if (values_.count("version")) {
    std::cout << "pcl6d " << PCL6D_VERSION << '\n';
    return true;
  }
  return false;
}

bool
CommandLine::parse(const std::vector<std::string>& arguments)
{
  std::string config;
  group("General options")
      .add_options() //
      ("config",
       po::value(&config)->value_name("FILE"),
       "read options from FILE, lines `name = value`; the command line wins") //
      ("help,h", "print this text and exit")                                  //
      ("version", "print the version and exit");
  readArguments(arguments);
  if (answerQuestions())
    return false;
  if (values_.count("config"))
    readConfig(values_["config"].as<std::string>());
  if (!bringing_option_.empty() && values_.count(bringing_option_)) {
    const auto value = values_[bringing_option_].as<std::string>();
    std::istringstream lines(brought_lines_(value));
    readLines(lines, "--" + bringing_option_ + " " + value);
  }
  for (const auto& name : positional_names_)
    if (!values_.count(name))
      throw UsageError(name + " is missing");
  po::notify(values_);
  return true;
}

bool
CommandLine::given(const std::string& option) const
{
  return values_.count(option) && !values_[option].defaulted();
}

std::string
CommandLine::withoutEffect(const std::vector<ConditionalOption>& options) const
{
  std::string text;
  for (const auto& option : options)
    if (!option.used && given(option.name))
      text += (text.empty() ? "no effect in this run: --" : ", --") + option.name +
              " (" + option.condition + ")";
  return text;
}

std::istream&
operator>>(std::istream& stream, AutoDouble& value)
{
  std::string word;
  stream >> word;
  value = AutoDouble();
  if (word == "auto")
    return stream;
  std::size_t used = 0;
  try {
    value.value = std::stod(word, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  value.is_auto = false;
  if (used == 0 || used != word.size())
    stream.setstate(std::ios::failbit);
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const AutoDouble& value)
{
  return value.is_auto ? stream << "auto" : stream << value.value;
}

} // namespace pcl6d::app
