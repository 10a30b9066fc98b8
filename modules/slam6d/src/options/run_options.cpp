// SPDX-License-Identifier: BSD-3-Clause
// The options of stages with only one or two options.
#include "option_words.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/slam6d/slam6d_options.h>

namespace pcl6d {

namespace {
constexpr Named<RecoveryEffort> kEfforts[] = {{RecoveryEffort::kOff, "off"},
                                              {RecoveryEffort::kBounded, "bounded"},
                                              {RecoveryEffort::kThorough, "thorough"}};
} // namespace

const char*
toString(RecoveryEffort effort)
{
  return nameOf(kEfforts, effort);
}

std::vector<std::string>
recoveryEffortNames()
{
  return namesOf(kEfforts);
}

RecoveryEffort
recoveryEffortFromName(const std::string& name)
{
  return fromName(kEfforts, "recovery effort", name);
}

void
describe(RecoveryOptions& o, OptionList& list)
{
  list.stage(OptionStage::kRecovery);
  list.group("Limits of matching");
  list.addChoice("recovery", o.recovery, recoveryEffortFromName)
      .withHelp(slam6d::withBars(recoveryEffortNames()) +
                ": search the whole map for scans that cannot be matched; bounded: "
                "searches without success take about the time of matching");
}

void
describe(DynamicOptions& o, OptionList& list)
{
  list.stage(OptionStage::kDynamic);
  list.group("Run");
  list.addField("leave_out_moving", o.leave_out_moving)
      .withHelp("the last round of relaxation leaves out dynamic points where these "
                "may pull a scan; off with --moving keep");
}

void
describe(MotionOptions& o, OptionList& list)
{
  list.stage(OptionStage::kDeskew);
  list.group("Input");
  list.add("knots SECONDS", o.knots)
      .inUnit("s")
      .within({0,
               std::numeric_limits<double>::max(),
               false,
               true,
               false,
               "finite and > 0 s"})
      .withHelp("[s] or auto: time between two estimated poses of a scan, of --deskew "
                "estimate; auto: a third of a second, or a pose at the begin and at "
                "the end if the scan is shorter than half a second");
}

void
describe(ControlOptions& o, OptionList& list)
{
  list.stage(OptionStage::kControl);
  list.group("Control points");
  const auto has_points = [&o] { return !o.points.empty(); };
  const std::string of_control = "of --control";
  list.add("control-sigma", o.control_sigma)
      .inUnit("m")
      .within(finiteAbove0())
      .countsIf(has_points, of_control)
      .withHelp("[m] standard deviation of each coordinate of the control points given "
                "without a sigma");
  list.add("target-sigma", o.target_sigma)
      .inUnit("m")
      .within(finiteAbove0())
      .countsIf(has_points, of_control)
      .withHelp("[m] standard deviation of each coordinate of a target in the scan");
}

void
describe(VerificationOptions& o, OptionList& list)
{
  list.stage(OptionStage::kVerification);
  list.group("Run");
  list.add("no-verification", o.verify)
      .as(OptionRole::kOutput)
      .withHelp("do not verify the final map by the points and rays of the scans");
}

void
describe(RunOptions& o, OptionList& list)
{
  list.stage(OptionStage::kRun);
  list.group("Run");
  list.add("threads", o.num_threads)
      .within({0, 1024, true, true, true, "in [0, 1024]"})
      .calledField("num_threads")
      .as(OptionRole::kSpeed)
      .withHelp("0: a thread per core; never changes the result");
  list.add("seed", o.seed)
      .within(from0())
      .withHelp(
          "seed of random choices (--initial-guess features, --reduction random)");
}

} // namespace pcl6d
