// SPDX-License-Identifier: BSD-3-Clause
// Rows of the option table: an option and its variable.
#include "common/options/option_table.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <algorithm>

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

} // namespace pcl6d::app
