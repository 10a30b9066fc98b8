// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/output/output_folder.h"
#include "convert/loss_tally.h"
#include "convert/verbs.h"

#include <pcl6d/common/pose_graph.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

#include <iostream>

namespace pcl6d::app {

namespace {
struct TrajectorySettings {
  std::string input;
  std::string output;
  TrajectoryFormat format = TrajectoryFormat::kAuto; ///< of the output
  TrajectoryFormat input_format = TrajectoryFormat::kAuto;
};

constexpr const char* kTrajectoryUsage =
    R"( trajectory IN -o OUT [options]
Writes poses in another format: rows of KITTI (T_world_scan) or TUM (stamp, position,
quaternion), the vertices of a g2o graph, or a folder with a 3DTK .pose or .frames
file per scan (left-handed centimetres; of .frames the last line counts). Right-
handed metres, 17 digits.
)";

/** \return the format to write, as given or by the extension of OUT */
TrajectoryFormat
outputFormat(const TrajectorySettings& s)
{
  const TrajectoryFormat of_file = trajectoryFormatOfExtension(s.output);
  if (s.format == TrajectoryFormat::kAuto && of_file == TrajectoryFormat::kAuto)
    throw UsageError("--format is missing: the extension of " + s.output +
                     " is unknown; give kitti, tum, g2o, pose or frames");
  if (s.format != TrajectoryFormat::kAuto && of_file != TrajectoryFormat::kAuto &&
      s.format != of_file)
    throw UsageError(std::string("--format = ") + toString(s.format) + ", but " +
                     s.output + " has the extension of " + toString(of_file));
  return s.format == TrajectoryFormat::kAuto ? of_file : s.format;
}

bool
parse(const std::vector<std::string>& arguments, TrajectorySettings& s)
{
  OptionTable table(std::string("usage: ") + kConvert + kTrajectoryUsage);
  table.positional("IN", &s.input);
  table.group("Output");
  table.add("output,o OUT", &s.output)
      .required()
      .help("file; a new folder for pose and frames");
  table.add("format NAME", &s.format, trajectoryFormatFromName)
      .help("auto|kitti|tum|g2o|pose|frames; auto: by the extension of OUT");
  table.group("Input");
  table.add("input-format NAME", &s.input_format, trajectoryFormatFromName)
      .help("auto|kitti|tum|g2o|pose|frames; auto: .g2o by extension, rows by the "
            "number of columns, a folder by the files");
  if (!table.parse(arguments))
    return false;
  s.format = outputFormat(s);
  refuseInputs(s.output, {s.input}, "the input");
  return true;
}

/** Writes one file per pose. */
void
writeFolder(const TrajectorySettings& s, const TrajectoryFiles& input)
{
  OutputRules rules;
  rules.folder = s.output;
  rules.inputs = {s.input};
  rules.program = kConvert;
  OutputFolder out(rules);
  const auto& poses = input.trajectory.poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string name =
        input.names.empty() ? scanName(static_cast<int>(i)) : input.names[i];
    if (s.format == TrajectoryFormat::kPose)
      writeUosPose(out / (name + ".pose"), poses[i]);
    else
      writeFrames(out / (name + ".frames"), {{poses[i], FrameKind::kInactive}});
  }
  out.publish();
}

/** \return whether the format stores stamps */
bool
holdsStamps(TrajectoryFormat format)
{
  return format == TrajectoryFormat::kTum;
}

void
write(const TrajectorySettings& s, const TrajectoryFiles& input)
{
  Trajectory trajectory = input.trajectory;
  if (trajectory.stamps.empty())
    for (std::size_t i = 0; i < trajectory.poses.size(); ++i)
      trajectory.stamps.push_back(static_cast<double>(i));
  PoseGraph graph;
  switch (s.format) {
  case TrajectoryFormat::kKitti:
    return writeTrajectoryKitti(s.output, trajectory);
  case TrajectoryFormat::kTum:
    return writeTrajectoryTum(s.output, trajectory);
  case TrajectoryFormat::kG2o:
    graph.poses = trajectory.poses;
    return writePoseGraphG2o(s.output, graph);
  default:
    return writeFolder(s, input);
  }
}

void
describe(const TrajectorySettings& s, const TrajectoryFiles& input)
{
  std::cout << text::counted(input.trajectory.poses.size(), "pose") << ": "
            << toString(input.format) << " to " << toString(s.format) << '\n';
  for (const auto& thing : input.left_out)
    std::cout << "did not read " << thing << '\n';
  const bool has_stamps = !input.trajectory.stamps.empty();
  if (has_stamps && !holdsStamps(s.format))
    std::cout << "dropped the stamps\n";
  if (has_stamps && holdsStamps(s.format))
    std::cout << "stamps kept\n";
  if (!has_stamps && holdsStamps(s.format))
    std::cout << "stamps made from the indices: 0, 1, ...\n";
  flushOutput();
}
} // namespace

int
runTrajectory(const std::vector<std::string>& arguments)
{
  TrajectorySettings settings;
  if (!parse(arguments, settings))
    return kDone;
  const TrajectoryFiles input =
      readTrajectoryFiles(settings.input, settings.input_format);
  write(settings, input);
  describe(settings, input);
  return kDone;
}

} // namespace pcl6d::app
