// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/options/option_groups.h"
#include "slam6d/options/options_page.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cctype>

namespace pcl6d::app {

namespace {
constexpr char kIntroduction[] = R"(# Options of pcl_slam6d

Every option of the main job, by the stage of the run that it belongs to. Made of the table in the
sources by `cmake --build build/release --target options_page`; do not edit.
What the methods do: [run_folder.md](run_folder.md). On the command line an option is `--name value`,
in a file given by `--config` it is `name = value`.

- *default*: `auto` means that the value is derived from the first 16 scans, or, for loops and
  links, from the matched scans.
- *result*: `yes` means that the option may change the poses. An interrupted run resumes only if
  every option so marked has its former value. `--continue` reuses the values given to the
  previous run, except of the options that select the input.
- An option in *italics* is a field of `pcl6d::Slam6DOptions` that only callers of the library set.
)";

/** \return the caption of a stage */
std::string
captionOf(OptionStage stage)
{
  std::string name = toString(stage);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/** Writes the default of a variable. */
struct DefaultText {
  bool is_field; ///< of the library, no option

  std::string
  operator()(const OptionWordReader&) const
  {
    return "";
  }
  std::string
  operator()(const bool* value) const
  {
    return is_field && *value ? "yes" : "no"; // a switch is off
  }
  std::string
  operator()(const double* value) const
  {
    return text::shortest(*value);
  }
  template <typename T>
  std::string
  operator()(const T* value) const
  {
    if constexpr (std::is_arithmetic_v<T>)
      return std::to_string(*value);
    else
      return "";
  }
};

std::string
defaultOf(const OptionSpec& option)
{
  if (!option.derived.empty())
    return "auto: " + option.derived;
  if (!option.usual.empty())
    return option.usual;
  const std::string text =
      std::visit(DefaultText{option.role == OptionRole::kLibrary}, option.variable);
  if (!text.empty())
    return text;
  const bool is_auto =
      std::holds_alternative<std::optional<double>*>(option.variable) &&
      option.otherwise.empty();
  return is_auto ? "auto" : option.otherwise.empty() ? "none" : option.otherwise;
}

/** \return the text, escaped for a table cell */
std::string
cell(const std::string& text)
{
  std::string escaped;
  for (const char letter : text)
    escaped += letter == '|' ? "\\|" : std::string(1, letter);
  return escaped;
}

std::string
rowOf(const OptionSpec& option)
{
  const bool is_field = option.role == OptionRole::kLibrary;
  std::string name = is_field ? '*' + option.name + '*' : "`--" + option.name + '`';
  if (!option.short_name.empty())
    name += ", `-" + option.short_name + '`';
  const bool changes =
      changesResult(option.role) || option.role == OptionRole::kLibrary;
  std::string help = option.help; // the unit and auto have columns of their own
  if (const auto begin = help.find("or auto: "); begin < 8)
    help.erase(0, begin + 9);
  return "| " + name + " | " + option.unit + " | " + cell(defaultOf(option)) + " | " +
         cell(option.range.words) + " | " + (changes ? "yes" : "no") + " | " +
         cell(option.condition) + " | " + cell(help) + " |\n";
}
} // namespace

std::string
optionsPage()
{
  Settings settings;
  Slam6DParameters used;
  const OptionList options = optionsOf(settings, used);
  std::string page = kIntroduction;
  for (int step = 0; step <= static_cast<int>(OptionStage::kRun); ++step) {
    const auto stage = static_cast<OptionStage>(step);
    page +=
        "\n## " + captionOf(stage) +
        "\n| option | unit | default | range | result | counts only | what it does |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const OptionSpec& option : options.rows())
      if (option.stage == stage)
        page += rowOf(option);
  }
  return page;
}

} // namespace pcl6d::app
