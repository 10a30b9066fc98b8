// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl6d {

namespace {
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

constexpr Named<OptionStage> kStages[] = {{OptionStage::kRead, "read"},
                                          {OptionStage::kPreprocess, "preprocess"},
                                          {OptionStage::kMatching, "matching"},
                                          {OptionStage::kRecovery, "recovery"},
                                          {OptionStage::kLoops, "loops"},
                                          {OptionStage::kRelaxation, "relaxation"},
                                          {OptionStage::kControl, "control points"},
                                          {OptionStage::kDynamic, "dynamic"},
                                          {OptionStage::kDeskew, "deskew"},
                                          {OptionStage::kVerification, "verification"},
                                          {OptionStage::kWrite, "write"},
                                          {OptionStage::kRun, "run"}};

/** Checks a numeric variable. */
struct RangeCheck {
  const OptionSpec& option;

  template <typename Number>
  void
  of(const Number& value) const
  {
    require(option.range.holds(static_cast<double>(value)),
            option.field.c_str(),
            value,
            option.range.words);
  }
  template <typename Number>
  void
  operator()(const std::optional<Number>* value) const
  {
    if (*value)
      of(**value);
  }
  template <typename Value>
  void
  operator()(const Value* value) const
  {
    if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>)
      of(*value);
  }
  void
  operator()(const OptionWordReader&) const
  {}
};
} // namespace

const char*
toString(OptionStage stage)
{
  return nameOf(kStages, stage);
}

bool
isInSummary(OptionRole role)
{
  return role != OptionRole::kSession && role != OptionRole::kLibrary;
}

bool
changesResult(OptionRole role)
{
  return role == OptionRole::kMethod || role == OptionRole::kInput ||
         role == OptionRole::kInputFile;
}

bool
mustStayAlike(OptionRole role)
{
  return role == OptionRole::kMethod || role == OptionRole::kInput;
}

bool
isTakenOver(OptionRole role)
{
  return role == OptionRole::kMethod || role == OptionRole::kOutput;
}

bool
OptionRange::holds(double value) const
{
  return (with_low ? value >= low : value > low) &&
         (with_high ? value <= high : value < high) &&
         (!whole || value == std::floor(value));
}

OptionRange
finiteAbove0()
{
  return {0, kLargest, false, true, false, "finite and > 0"};
}

OptionRange
finiteFrom0()
{
  return {0, kLargest, true, true, false, "finite and >= 0"};
}

OptionRange
above0()
{
  return {0, kInfinite, false, true, false, "> 0"};
}

OptionRange
from0()
{
  return {0, kInfinite, true, true, false, ">= 0"};
}

OptionRange
from1()
{
  return {1, kInfinite, true, true, false, ">= 1"};
}

OptionSpec::OptionSpec(const std::string& words, OptionVariable of, const void* at)
: variable(std::move(of)), place(at)
{
  const std::size_t blank = words.find(' ');
  if (blank != std::string::npos)
    operand = words.substr(blank + 1);
  name = words.substr(0, blank);
  if (const std::size_t comma = name.find(','); comma != std::string::npos) {
    short_name = name.substr(comma + 1);
    name.resize(comma);
  }
  field = name;
  std::replace(field.begin(), field.end(), '-', '_');
}

OptionSpec&
OptionSpec::withHelp(const std::string& text)
{
  help = text;
  return *this;
}

OptionSpec&
OptionSpec::derivedAs(const std::string& text, Parameter& value)
{
  derived = text;
  parameter = &value;
  return *this;
}

OptionSpec&
OptionSpec::inUnit(const std::string& text)
{
  unit = text;
  return *this;
}

OptionSpec&
OptionSpec::within(const OptionRange& numbers)
{
  range = numbers;
  return *this;
}

OptionSpec&
OptionSpec::as(OptionRole purpose)
{
  role = purpose;
  return *this;
}

OptionSpec&
OptionSpec::calledField(const std::string& text)
{
  field = text;
  return *this;
}

OptionSpec&
OptionSpec::withDefault(const std::string& word)
{
  usual = word;
  return *this;
}

OptionSpec&
OptionSpec::ifNotGiven(const std::string& word)
{
  otherwise = word;
  return *this;
}

OptionSpec&
OptionSpec::impliedWord(const std::string& word)
{
  implied = word;
  return *this;
}

OptionSpec&
OptionSpec::mayRepeat()
{
  repeatable = true;
  return *this;
}

OptionSpec&
OptionSpec::countsIf(std::function<bool()> used, const std::string& when)
{
  is_used = std::move(used);
  condition = when;
  return *this;
}

OptionSpec&
OptionSpec::readBy(std::function<void(const std::string&)> take)
{
  variable = OptionWordReader{std::move(take)};
  return *this;
}

void
OptionSpec::check() const
{
  if (!range.words.empty())
    std::visit(RangeCheck{*this}, variable);
}

void
OptionList::stage(OptionStage step)
{
  stage_ = step;
}

void
OptionList::group(const std::string& caption)
{
  group_ = caption;
}

OptionSpec&
OptionList::addRow(OptionSpec row)
{
  row.stage = stage_;
  row.group = group_;
  rows_.push_back(std::move(row));
  return rows_.back();
}

OptionSpec&
OptionList::append(const OptionSpec& option)
{
  rows_.push_back(option);
  return rows_.back();
}

void
OptionList::append(const OptionList& options, OptionStage step)
{
  for (const OptionSpec& option : options.rows())
    if (option.stage == step)
      append(option);
}

const OptionSpec&
OptionList::of(const void* variable) const
{
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const auto& row) {
    return row.place == variable;
  });
  if (found == rows_.end())
    throw std::logic_error("no option sets this variable");
  return *found;
}

OptionSpec&
OptionList::of(const void* variable)
{
  return const_cast<OptionSpec&>(std::as_const(*this).of(variable));
}

void
OptionList::check() const
{
  for (const OptionSpec& row : rows_)
    row.check();
}

} // namespace pcl6d
