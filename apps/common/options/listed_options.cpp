// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/listed_options.h"

namespace pcl6d::app {

namespace {
/** Adds the row of a table for the type of the variable. */
struct RowAdder {
  OptionTable& table;
  const OptionSpec& option;
  std::string name; ///< in the form of the table: "output,o OUT_DIR"

  Option&
  operator()(const OptionWordReader& reader) const
  {
    return table.addWord(name, option.usual, reader.take);
  }
  Option&
  operator()(std::optional<double>* number) const
  {
    return table.addAuto(name, number);
  }
  /** Reads an unsigned number as signed, to reject a minus sign. */
  Option&
  operator()(unsigned int* number) const
  {
    return table.addAs<int>(name, number)
        .within(option.range.low, option.range.high, option.range.words);
  }
  Option&
  operator()(std::uint64_t* number) const
  {
    return table.addAs<std::int64_t>(name, number)
        .within(option.range.low, option.range.high, option.range.words);
  }
  template <typename T>
  Option&
  operator()(T* variable) const
  {
    return table.add(name, variable);
  }
};
} // namespace

void
addOption(OptionTable& table, const OptionSpec& option)
{
  std::string name = option.name;
  if (!option.short_name.empty())
    name += ',' + option.short_name;
  if (!option.operand.empty())
    name += ' ' + option.operand;
  Option& row = std::visit(RowAdder{table, option, name}, option.variable);
  row.help(option.help).otherwise(option.otherwise).implied(option.implied);
  if (option.repeatable)
    row.composing();
}

void
addOptions(OptionTable& table, const OptionList& options)
{
  std::string group;
  for (const OptionSpec& option : options.rows()) {
    if (option.role == OptionRole::kLibrary)
      continue;
    if (option.group != group)
      table.group(option.group);
    group = option.group;
    addOption(table, option);
  }
}

std::vector<std::string>
namesOf(const OptionList& options, bool (*has)(OptionRole))
{
  std::vector<std::string> names;
  for (const OptionSpec& option : options.rows())
    if (has(option.role))
      names.push_back(option.name);
  return names;
}

std::string
withoutEffect(const OptionTable& table, const OptionList& options)
{
  std::vector<ConditionalOption> conditional;
  for (const OptionSpec& option : options.rows())
    if (option.is_used)
      conditional.push_back({option.name, option.is_used(), option.condition});
  return table.withoutEffect(conditional);
}

std::map<std::string, std::string>
optionsOfFields(const OptionList& options)
{
  std::map<std::string, std::string> names;
  for (const OptionSpec& option : options.rows())
    if (option.role != OptionRole::kLibrary)
      names[option.field] = option.name;
  return names;
}

} // namespace pcl6d::app
