// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "common/output_folder.h"
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
namespace po = boost::program_options;
namespace fs = std::filesystem;

struct TrajectorySettings {
  std::string input;
  std::string output;
  TrajectoryFormat format = TrajectoryFormat::kAuto; ///< of the output
  TrajectoryFormat input_format = TrajectoryFormat::kAuto;
};

constexpr const char* kUsageText =
    " trajectory IN -o OUT [options]\n"
    "Writes poses in another format: rows of KITTI (T_world_scan) or TUM (stamp, "
    "position,\n"
    "quaternion), the vertices of a g2o graph, or a folder with a 3DTK .pose or "
    ".frames\n"
    "file per scan (left-handed centimetres; of .frames the last line counts). Right-\n"
    "handed metres, 17 digits.\n";

/** \return the format to write, from its name or the extension of OUT */
TrajectoryFormat
outputFormat(const std::string& name, const std::string& output)
{
  const TrajectoryFormat named = trajectoryFormatFromName(name);
  const TrajectoryFormat of_file = trajectoryFormatOfExtension(output);
  if (named == TrajectoryFormat::kAuto && of_file == TrajectoryFormat::kAuto)
    throw UsageError("--format is missing, as the extension of " + output +
                     " is that of none: kitti, tum, g2o, pose or frames");
  if (named != TrajectoryFormat::kAuto && of_file != TrajectoryFormat::kAuto &&
      named != of_file)
    throw UsageError("--format = " + name + ", but " + output +
                     " has the extension of " + toString(of_file));
  return named == TrajectoryFormat::kAuto ? of_file : named;
}

bool
parse(const std::vector<std::string>& arguments, TrajectorySettings& s)
{
  CommandLine line(std::string("usage: ") + kConvert + kUsageText);
  std::string format = "auto", input_format = "auto";
  line.positional("IN", &s.input);
  line.group("Output").add_options() //
      ("output,o",
       po::value(&s.output)->value_name("OUT")->required(),
       "file; a new folder for pose and frames") //
      ("format",
       valueOf(format)->value_name("NAME"),
       "auto|kitti|tum|g2o|pose|frames; auto: by the extension of OUT");
  line.group("Input").add_options() //
      ("input-format",
       valueOf(input_format)->value_name("NAME"),
       "auto|kitti|tum|g2o|pose|frames; auto: .g2o by extension, rows by their "
       "columns, "
       "a folder by its files");
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { s.input_format = trajectoryFormatFromName(input_format); },
               {{"format", "input-format"}});
  checkOptions([&] { s.format = outputFormat(format, s.output); });
  std::error_code missing; // a missing file is no input
  if (fs::equivalent(s.output, s.input, missing))
    throw UsageError("--output = " + s.output + ", but that is the input");
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

/** \return whether the format has a place for stamps */
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
