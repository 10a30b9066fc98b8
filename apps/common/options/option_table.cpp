// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/help_text.h"
#include "common/options/option_table.h"
#include "common/options/option_words.h"
#include "common/output/run_files.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/version.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <regex>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace fs = std::filesystem;

OptionTable::OptionTable(const std::string& usage) : usage_(usage)
{}

void
OptionTable::group(const std::string& caption)
{
  groups_.push_back({caption, {}});
}

po::options_description
OptionTable::describe(const Group& group)
{
  po::options_description rows;
  for (const auto& row : group.rows)
    rows.add_options()(row.name_.c_str(), row.semantic_(row), row.help_.c_str());
  return rows;
}

po::options_description
OptionTable::describeAll() const
{
  po::options_description all;
  for (const auto& group : groups_)
    all.add(describe(group));
  return all;
}

namespace {
/** The options of every program; a config file cannot set these. */
po::options_description
generalOptions()
{
  po::options_description general;
  general.add_options()(
      "config",
      po::value<std::string>()->value_name("FILE"),
      "read options from FILE, lines `name = value`; the command line wins");
  general.add_options()("help,h", "print this text and exit");
  general.add_options()("version", "print the version and exit");
  return general;
}

/** \return the message about an option that no table has, with the option that was perhaps meant */
std::string
wordsOfUnknown(po::unknown_option& error, const po::options_description& all)
{
  std::vector<std::string> names;
  for (const auto& option : all.options())
    names.push_back("--" + option->long_name());
  const std::string nearest = nearestWord(error.get_option_name(), names);
  return app::wordsOf(error) +
         (nearest.empty() ? std::string() : "; did you mean " + nearest + "?");
}

/** \return the message about a value that cannot be read, with what the option takes */
std::string
wordsOfUnreadable(po::invalid_option_value& error, const po::options_description& all)
{
  std::string name = error.get_option_name();
  name.erase(0, name.find_first_not_of('-'));
  const po::option_description* const option = all.find_nothrow(name, false);
  return app::wordsOf(error) +
         (option ? "; it takes: " + option->description() : std::string());
}
} // namespace

void
OptionTable::readArguments(const std::vector<std::string>& arguments)
{
  using Style = po::command_line_style::style_t;
  po::options_description all = describeAll();
  all.add(generalOptions()).add(hidden_);
  try {
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(positions_)
                  .style(po::command_line_style::unix_style ^ Style::allow_guessing)
                  .run(),
              values_);
  } catch (po::unknown_option& e) {
    throw UsageError(wordsOfUnknown(e, all));
  } catch (po::invalid_option_value& e) {
    throw UsageError(wordsOfUnreadable(e, all));
  } catch (const po::too_many_positional_options_error&) {
    throw UsageError("too many arguments; expected " + joined(positional_names_, " ") +
                     ", and everything else with the name of its option");
  }
}

bool
OptionTable::answerQuestions() const
{
  if (values_.count("help")) {
    const int columns = helpColumns();
    std::cout << usage_;
    for (const auto& group : groups_)
      std::cout << '\n'
                << group.caption << ":\n"
                << helpLines(describe(group), columns);
    std::cout << "\nGeneral options:\n"
              << helpLines(generalOptions(), columns) << helpEnd();
    return true;
  }
  if (values_.count("version")) {
    std::cout << "pcl6d " << PCL6D_VERSION << '\n';
    return true;
  }
  return false;
}

namespace {
/** \return whether a value, or an element of a list, is an empty text, mostly from an
 * unset variable of the shell */
bool
holdsEmptyText(const boost::any& value)
{
  if (const auto* const text = boost::any_cast<std::string>(&value))
    return text->empty();
  const auto* const texts = boost::any_cast<std::vector<std::string>>(&value);
  return texts && std::find(texts->begin(), texts->end(), "") != texts->end();
}
} // namespace

void
OptionTable::refuseEmptyTexts() const
{
  for (const auto& [name, value] : values_) {
    if (value.defaulted() || !holdsEmptyText(value.value()))
      continue;
    const bool is_option =
        std::find(positional_names_.begin(), positional_names_.end(), name) ==
        positional_names_.end();
    blame(name, (is_option ? "--" : "") + name + " is empty");
  }
}

bool
OptionTable::parse(const std::vector<std::string>& arguments)
{
  readArguments(arguments);
  if (answerQuestions())
    return false;
  refuseEmptyTexts(); // before the files named by options are opened
  if (values_.count("config"))
    readConfig(values_["config"].as<std::string>());
  if (!bringing_option_.empty() && values_.count(bringing_option_))
    readBrought(brought_options_(values_[bringing_option_].as<std::string>()));
  refuseEmptyTexts();
  for (const auto& name : positional_names_)
    if (!values_.count(name))
      throw UsageError(name + " is missing");
  po::notify(values_);
  takeValues();
  return true;
}

void
OptionTable::takeValues() const
{
  for (const auto& group : groups_)
    for (const Option& row : group.rows) {
      const std::string name = row.name_.substr(0, row.name_.find(','));
      if (!given(name))
        continue;
      const boost::any& value = values_[name].value();
      const std::string text = row.text_(value);
      try {
        checkOption(name, [&] {
          if (row.number_ && text != "auto") {
            const double number = row.number_(value);
            require(row.obeys_ ? row.obeys_(number) : !std::isnan(number),
                    "it",
                    text,
                    row.obeys_ ? row.rule_ : "a number");
          }
          row.take_(value);
        });
      } catch (const UsageError& e) {
        blame(name, e.what());
      }
    }
}

bool
OptionTable::given(const std::string& option) const
{
  return values_.count(option) && !values_[option].defaulted();
}

const Option&
OptionTable::row(const std::string& option) const
{
  for (const auto& group : groups_)
    for (const Option& row : group.rows)
      if (row.name_.substr(0, row.name_.find(',')) == option)
        return row;
  throw std::logic_error("no option --" + option);
}

std::vector<OptionWord>
OptionTable::words(const std::vector<std::string>& options) const
{
  std::vector<OptionWord> words;
  for (const auto& name : options) {
    const Option& option = row(name);
    const bool is_given = given(name);
    const std::string usual = option.usual_.empty() ? option.otherwise_ : option.usual_;
    words.push_back(
        {name, is_given ? option.text_(values_[name].value()) : usual, is_given});
  }
  return words;
}

std::string
OptionTable::withoutEffect(const std::vector<ConditionalOption>& options) const
{
  std::string text;
  for (const auto& option : options)
    if (!option.used && given(option.name))
      text += (text.empty() ? "no effect in this run: --" : ", --") + option.name +
              " (" + option.condition + ")";
  return text;
}

void
OptionTable::needFolder(const std::string& input,
                        const std::vector<std::string>& options) const
{
  if (fs::is_directory(input))
    return;
  for (const auto& option : options)
    if (given(option))
      throw UsageError("--" + option + " needs a folder, but " + input + " is none");
}

std::string
joined(const std::vector<std::string>& words, const std::string& between)
{
  std::string text;
  for (const auto& word : words)
    text += (text.empty() ? "" : between) + word;
  return text;
}

namespace {
/** \return whether a file was written to a run by pcl_slam6d and is read by other programs */
bool
isFileOfRun(const fs::path& file, const fs::path& run)
{
  static const std::regex kFiles(runFilePattern());
  std::error_code error;
  if (!fs::is_regular_file(run / "summary.json", error) || !fs::exists(file, error))
    return false;
  const fs::path within =
      fs::canonical(file, error).lexically_relative(fs::canonical(run, error));
  return std::regex_match(within.generic_string(), kFiles);
}
} // namespace

void
refuseInputs(const std::string& output,
             const std::vector<std::string>& inputs,
             const std::string& input,
             const std::string& option)
{
  std::error_code missing; // a missing file is no input
  for (const auto& file : inputs)
    if (fs::equivalent(output, file, missing) || isFileOfRun(output, file))
      throw UsageError(option + " = " + output + ", but that is " + input);
}

void
refuseSameOutput(const std::string& option,
                 const std::string& output,
                 const std::string& other_option,
                 const std::string& other)
{
  std::error_code error;
  // also of a file that does not exist
  const auto place = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  if (!output.empty() && !other.empty() && place(output) == place(other))
    throw UsageError(option + " and " + other_option + " are both " + other);
}

} // namespace pcl6d::app
