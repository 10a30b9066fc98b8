// SPDX-License-Identifier: BSD-3-Clause
#include "option_words.h"

#include <pcl6d/common/option_names.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/slam6d/slam6d_result.h>

namespace pcl6d {

namespace {
constexpr char kNoRelaxation[] = "none", kSimultaneous[] = "simultaneous";

void
takeRelaxation(const std::string& word, RelaxationOptions& o)
{
  o.simultaneous = word == kSimultaneous;
  o.relaxation = word == kNoRelaxation || o.simultaneous
                     ? std::nullopt
                     : std::make_optional(relaxationFromName(word));
}

std::string
relaxationWord(const RelaxationOptions& o)
{
  if (o.simultaneous)
    return kSimultaneous;
  return o.relaxation ? toString(*o.relaxation) : kNoRelaxation;
}

void
describeLinks(RelaxationOptions& o, Slam6DParameters& used, OptionList& list)
{
  const auto relaxes = [&o] { return o.relaxation.has_value(); };
  const std::string of_relaxation = "of --relaxation";
  list.addChoice("links", o.links, linkRuleFromName)
      .countsIf(relaxes, of_relaxation)
      .withHelp(slam6d::withBars(linkRuleNames()) +
                ": links between overlapping scans, or between scans "
                "within --link-distance");
  list.add("link-distance", o.link_distance)
      .inUnit("m")
      .within(finiteAbove0())
      .derivedAs("1.5 times the loop distance", used.link_distance)
      .countsIf([&o] { return o.relaxation && o.links == LinkRule::kDistance; },
                "of --links distance")
      .withHelp("[m] or auto: of --links distance");
  list.add("link-hysteresis", o.link_hysteresis)
      .within({0, 1, true, false, false, "in [0, 1)"})
      .countsIf(relaxes, of_relaxation)
      .withHelp("share by which a link may fall short of the criterion of creation "
                "before being dropped");
  list.addChoice("link-weights", o.link_weights, linkWeightsFromName)
      .countsIf(relaxes, of_relaxation)
      .withHelp(slam6d::withBars(linkWeightsNames()) +
                ": weight of a link during relaxation: equal, by the number of pairs, "
                "or by the covariance from the pairs");
  list.add("relaxation-rounds", o.relaxation_rounds)
      .within(above0())
      .countsIf(relaxes, of_relaxation)
      .withHelp("most rounds, with links and pairs anew in each");
}
} // namespace

void
describe(RelaxationOptions& o, Slam6DParameters& used, OptionList& list)
{
  list.stage(OptionStage::kRelaxation);
  list.group("Loops and graph");
  list.addWord(kRelaxationOption,
               o.relaxation,
               [&o](const std::string& word) { takeRelaxation(word, o); })
      .withDefault(relaxationWord(o))
      .withHelp(
          slam6d::withBars(relaxationNames()) +
          "|simultaneous|none: method that moves all scans at once after matching; "
          "simultaneous: scan after scan, until the poses stay; reverted unless the "
          "scans agree clearly better");
  describeLinks(o, used, list);
}

} // namespace pcl6d
