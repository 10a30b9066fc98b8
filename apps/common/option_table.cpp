// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/help_text.h"
#include "common/option_table.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace fs = std::filesystem;

Option&
Option::help(const std::string& text)
{
  help_ = text;
  return *this;
}

Option&
Option::required()
{
  required_ = true;
  return *this;
}

Option&
Option::composing()
{
  composing_ = true;
  return *this;
}

Option&
Option::multitoken()
{
  multitoken_ = true;
  return *this;
}

Option&
Option::within(double low, double high, const std::string& rule)
{
  rule_ = rule;
  obeys_ = [=](double value) { return value >= low && value <= high; };
  return *this;
}

Option&
Option::above(double low, const std::string& rule, double high)
{
  rule_ = rule;
  obeys_ = [=](double value) { return value > low && value <= high; };
  return *this;
}

Option&
Option::otherwise(const std::string& word)
{
  otherwise_ = word;
  return *this;
}

Option&
Option::implied(const std::string& word)
{
  implied_ = word;
  return *this;
}

OptionTable::OptionTable(const std::string& usage) : usage_(usage)
{}

void
OptionTable::group(const std::string& caption)
{
  groups_.push_back({caption, {}});
}

Option&
OptionTable::addRow(const std::string& name, const std::string& usual)
{
  const std::size_t blank = name.find(' ');
  Option row;
  row.name_ = name.substr(0, blank);
  row.operand_ = blank == std::string::npos ? "" : name.substr(blank + 1);
  row.usual_ = usual;
  auto& rows = groups_.back().rows;
  rows.push_back(row);
  return rows.back();
}

Option&
OptionTable::add(const std::string& name, bool* variable)
{
  const bool usual = *variable;
  Option& row = addTyped<bool>(name, "no", [=](bool on) { *variable = usual != on; });
  row.semantic_ = [](const Option&) { return po::bool_switch(); };
  row.text_ = [](const boost::any& v) {
    return boost::any_cast<bool>(v) ? "yes" : "no";
  };
  return row;
}

Option&
OptionTable::add(const std::string& name, fs::path* variable)
{
  return addWord(
      name, variable->string(), [=](const std::string& file) { *variable = file; });
}

Option&
OptionTable::addAuto(const std::string& name,
                     std::optional<double>* variable,
                     double unit)
{
  Option& row = addTyped<AutoNumber>(name, "auto", [=](const AutoNumber& value) {
    *variable = value.number ? std::make_optional(unit * *value.number) : std::nullopt;
  });
  row.number_ = [](const boost::any& v) { // auto obeys each rule
    return boost::any_cast<AutoNumber>(v).number.value();
  };
  return row;
}

Option&
OptionTable::addWord(const std::string& name,
                     const std::string& usual,
                     std::function<void(const std::string&)> take)
{
  return addTyped<std::string>(name, usual, std::move(take));
}

std::size_t
OptionTable::placeOf(const std::string& word, const std::vector<std::string>& words)
{
  const auto place = std::find(words.begin(), words.end(), word);
  if (place == words.end())
    throw BadArgument("word = " + word + ", but must be " +
                      joined({words.begin(), words.end() - 1}, ", ") + " or " +
                      words.back());
  return static_cast<std::size_t>(place - words.begin());
}

void
OptionTable::positional(const std::string& name, std::string* value)
{
  hidden_.add_options()(name.c_str(), po::value(value));
  positions_.add(name.c_str(), 1);
  positional_names_.push_back(name);
}

void
OptionTable::positionals(const std::string& name, std::vector<std::string>* values)
{
  hidden_.add_options()(name.c_str(), po::value(values));
  positions_.add(name.c_str(), -1);
  positional_names_.push_back(name);
}

void
OptionTable::bringOptions(const std::string& option,
                          std::function<BroughtOptions(const std::string&)> options)
{
  bringing_option_ = option;
  brought_options_ = std::move(options);
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
/** The options that every program has; they have no sense in a config file. */
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
    std::cout << "\nGeneral options:\n" << helpLines(generalOptions(), columns);
    return true;
  }
  if (values_.count("version")) {
    std::cout << "pcl6d " << PCL6D_VERSION << '\n';
    return true;
  }
  return false;
}

namespace {
/** \return whether a value, or one of several, is a text of no letters: it names nothing,
 * mostly a variable of the shell that is not set */
bool
holdsEmptyText(const boost::any& value)
{
  if (const auto* const text = boost::any_cast<std::string>(&value))
    return text->empty();
  const auto* const texts = boost::any_cast<std::vector<std::string>>(&value);
  return texts && std::find(texts->begin(), texts->end(), "") != texts->end();
}
} // namespace

bool
OptionTable::parse(const std::vector<std::string>& arguments)
{
  readArguments(arguments);
  if (answerQuestions())
    return false;
  if (values_.count("config")) {
    if (holdsEmptyText(values_["config"].value()))
      throw UsageError("--config is empty");
    readConfig(values_["config"].as<std::string>());
  }
  if (!bringing_option_.empty() && values_.count(bringing_option_))
    readBrought(brought_options_(values_[bringing_option_].as<std::string>()));
  for (const auto& name : positional_names_) {
    if (!values_.count(name))
      throw UsageError(name + " is missing");
    if (holdsEmptyText(values_[name].value()))
      throw UsageError(name + " is empty");
  }
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
        if (holdsEmptyText(value))
          throw UsageError("--" + name + " is empty");
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

std::istream&
operator>>(std::istream& stream, AutoNumber& value)
{
  std::string word;
  stream >> word;
  value.number.reset();
  if (word == "auto")
    return stream;
  if (!text::parseNumber(word, value.number.emplace())) // whatever the locale
    stream.setstate(std::ios::failbit);
  return stream;
}

std::ostream&
operator<<(std::ostream& stream, const AutoNumber& value)
{
  return value.number ? stream << *value.number : stream << "auto";
}

std::string
joined(const std::vector<std::string>& words, const std::string& between)
{
  std::string text;
  for (const auto& word : words)
    text += (text.empty() ? "" : between) + word;
  return text;
}

void
refuseInputs(const std::string& output,
             const std::vector<std::string>& inputs,
             const std::string& input,
             const std::string& option)
{
  std::error_code missing; // a missing file is no input
  for (const auto& file : inputs)
    if (fs::equivalent(output, file, missing))
      throw UsageError(option + " = " + output + ", but that is " + input);
}

} // namespace pcl6d::app
