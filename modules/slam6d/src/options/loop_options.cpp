// SPDX-License-Identifier: BSD-3-Clause
#include "option_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/slam6d/slam6d_result.h>

namespace pcl6d {

namespace {
OptionRange
wholeCount()
{
  return {0, 1e9, false, false, true, "a whole number > 0"};
}

void
describeLengths(LoopOptions& o, Slam6DParameters& used, OptionList& list)
{
  list.add("loop-distance", o.loop_distance)
      .inUnit("m")
      .within(finiteAbove0())
      .derivedAs("the larger of half the median range and 4 steps", used.loop_distance)
      .withHelp(
          "[m] or auto: largest distance between the scans at the ends of a loop");
  list.add("loop-gap", o.loop_gap)
      .inUnit("scans")
      .within(wholeCount())
      .derivedAs("the number of scans along 5 loop distances, at least 4",
                 used.loop_gap)
      .withHelp("N or auto: least number of scans between the ends of a loop");
  list.add("loop-pairs", o.loop_pairs)
      .inUnit("pairs")
      .within(wholeCount())
      .derivedAs("5 % of the points of a reduced scan, at least 20, at most 250",
                 used.loop_pairs)
      .withHelp("N or auto: least pairs of points for a loop");
}

void
takeTime(const std::string& word, LoopOptions& o)
{
  if (word != "after" && word != "online")
    throw BadArgument("word = " + word + ", but must be after or online");
  o.close_loops_online = word == "online";
}
} // namespace

void
describe(LoopOptions& o, Slam6DParameters& used, OptionList& list)
{
  const auto closes = [&o] { return o.loop_closing != LoopClosing::kNone; };
  const std::string of_closing = "of --loop-closing";
  list.stage(OptionStage::kLoops);
  list.group("Loops and graph");
  list.addChoice(kLoopClosingOption, o.loop_closing, loopClosingFromName)
      .withHelp(slam6d::withBars(loopClosingNames()) +
                ": method that spreads the error of a loop; none: no search for loops");
  list.addWord("close-loops",
               o.close_loops_online,
               [&o](const std::string& word) { takeTime(word, o); })
      .withDefault(o.close_loops_online ? "online" : "after")
      .countsIf(closes, of_closing)
      .withHelp("after|online: close loops after the last scan is matched, or each "
                "loop before the next scan is matched");
  describeLengths(o, used, list);
  for (std::optional<double>* length : {&o.loop_distance, &o.loop_gap, &o.loop_pairs})
    list.of(length).countsIf(closes, of_closing);
  list.add("loop-gate", o.loop_gate)
      .within(above0())
      .countsIf(closes, of_closing)
      .withHelp(
          "largest squared Mahalanobis distance between the ends of a loop, by the "
          "covariances of the matches; 11.3 rejects 1 % of the true loops, inf: 0 %");
}

} // namespace pcl6d
