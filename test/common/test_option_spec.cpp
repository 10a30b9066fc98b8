// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/option_spec.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

using namespace pcl6d;
using pcl6d::test::badArgumentOf;

namespace {
const double kInfinity = std::numeric_limits<double>::infinity();
const double kNoNumber = std::numeric_limits<double>::quiet_NaN();

enum class OptionHue { kRed, kBlue };
const char*
toString(OptionHue colour)
{
  return colour == OptionHue::kRed ? "red" : "blue";
}
OptionHue
hueFromName(const std::string& name)
{
  if (name == "red")
    return OptionHue::kRed;
  if (name == "blue")
    return OptionHue::kBlue;
  throw BadArgument("colour = " + name + ", but must be red|blue");
}
} // namespace

TEST(OptionRange, HoldsItsEndsAsItSays)
{
  EXPECT_FALSE(finiteAbove0().holds(0));
  EXPECT_TRUE(finiteAbove0().holds(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(finiteAbove0().holds(std::numeric_limits<double>::max()));
  EXPECT_FALSE(finiteAbove0().holds(kInfinity));
  EXPECT_TRUE(finiteFrom0().holds(0));
  EXPECT_FALSE(finiteFrom0().holds(kInfinity));
  EXPECT_FALSE(finiteFrom0().holds(-1e-9));
  EXPECT_FALSE(above0().holds(0));
  EXPECT_TRUE(above0().holds(kInfinity));
  EXPECT_TRUE(from0().holds(0));
  EXPECT_FALSE(from1().holds(0.5));
  EXPECT_TRUE(from1().holds(1));
  const OptionRange open = {0, 1, true, false, false, "in [0, 1)"};
  EXPECT_TRUE(open.holds(0));
  EXPECT_FALSE(open.holds(1));
  for (const OptionRange& range :
       {finiteAbove0(), finiteFrom0(), above0(), from0(), from1(), open})
    EXPECT_FALSE(range.holds(kNoNumber)) << range.words;
}

TEST(OptionRange, OfWholeNumbersHoldsNoFraction)
{
  const OptionRange whole = {0, 1e9, false, false, true, "a whole number > 0"};
  EXPECT_TRUE(whole.holds(3));
  EXPECT_FALSE(whole.holds(3.5));
  EXPECT_FALSE(whole.holds(0));
  EXPECT_FALSE(whole.holds(1e9));
}

TEST(OptionSpec, TakesShortNameAndOperandOffTheName)
{
  std::string out;
  OptionList list;
  const OptionSpec& option = list.add("output-dir,o OUT DIR", out);
  EXPECT_EQ(option.name, "output-dir");
  EXPECT_EQ(option.short_name, "o");
  EXPECT_EQ(option.operand, "OUT DIR");
  EXPECT_EQ(option.field, "output_dir");
}

TEST(OptionList, NamesTheFirstVariableOutOfItsRange)
{
  int rounds = 1;
  std::optional<double> length;
  OptionList list;
  list.add("link-length", length).within(finiteAbove0());
  list.add("rounds", rounds).within(above0()).calledField("max_rounds");
  EXPECT_NO_THROW(list.check());
  rounds = 0;
  EXPECT_EQ(badArgumentOf([&] { list.check(); }), "max_rounds = 0, but must be > 0");
  length = kInfinity;
  EXPECT_EQ(badArgumentOf([&] { list.check(); }),
            "link_length = inf, but must be finite and > 0");
  length = kNoNumber;
  EXPECT_NE(badArgumentOf([&] { list.check(); }), "");
}

TEST(OptionList, ChecksNoSwitchesAndWords)
{
  bool on = true;
  OptionHue colour = OptionHue::kBlue;
  OptionList list;
  list.add("on", on).within({5, 6, true, true, false, "in [5, 6]"});
  list.addChoice("colour", colour, hueFromName).within(above0());
  EXPECT_NO_THROW(list.check());
}

TEST(OptionList, ReadsChoicesByTheirNames)
{
  OptionHue colour = OptionHue::kBlue;
  OptionList list;
  const OptionSpec& option = list.addChoice("colour", colour, hueFromName);
  EXPECT_EQ(option.usual, "blue");
  std::get<OptionWordReader>(option.variable).take("red");
  EXPECT_EQ(colour, OptionHue::kRed);
  EXPECT_THROW(std::get<OptionWordReader>(option.variable).take("green"), BadArgument);
}

TEST(OptionList, FindsOptionsByTheirVariables)
{
  int a = 0, b = 0, other = 0;
  OptionList list;
  list.add("first", a);
  list.add("second", b);
  EXPECT_EQ(list.of(&b).name, "second");
  EXPECT_THROW(list.of(&other), std::logic_error);
}

TEST(OptionList, AppendsTheOptionsOfAStageWithTheirGroup)
{
  int a = 0, b = 0, c = 0;
  OptionList from;
  from.stage(OptionStage::kLoops);
  from.group("Loops");
  from.add("a", a);
  from.stage(OptionStage::kRun);
  from.add("b", b);
  from.stage(OptionStage::kLoops);
  from.add("c", c);
  OptionList list;
  list.group("Other");
  list.append(from, OptionStage::kLoops);
  ASSERT_EQ(list.rows().size(), 2u);
  EXPECT_EQ(list.rows()[0].name, "a");
  EXPECT_EQ(list.rows()[1].name, "c");
  EXPECT_EQ(list.rows()[1].group, "Loops");
}

TEST(OptionRole, SaysWhoAsksForAnOption)
{
  struct Row {
    OptionRole role;
    bool in_summary, changes, alike, taken_over;
  };
  for (const Row& row : {Row{OptionRole::kMethod, true, true, true, true},
                         Row{OptionRole::kInput, true, true, true, false},
                         Row{OptionRole::kInputFile, true, true, false, false},
                         Row{OptionRole::kOutput, true, false, false, true},
                         Row{OptionRole::kSpeed, true, false, false, false},
                         Row{OptionRole::kSession, false, false, false, false},
                         Row{OptionRole::kLibrary, false, false, false, false}}) {
    EXPECT_EQ(isInSummary(row.role), row.in_summary);
    EXPECT_EQ(changesResult(row.role), row.changes);
    EXPECT_EQ(mustStayAlike(row.role), row.alike);
    EXPECT_EQ(isTakenOver(row.role), row.taken_over);
  }
}
