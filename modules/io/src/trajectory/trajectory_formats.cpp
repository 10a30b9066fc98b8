// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/natural_order.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;
using Format = TrajectoryFormat;

struct FormatName {
  Format format;
  const char* name;
  bool is_folder;
};
constexpr std::array<FormatName, 6> kFormats = {{{Format::kAuto, "auto", false},
                                                 {Format::kKitti, "kitti", false},
                                                 {Format::kTum, "tum", false},
                                                 {Format::kG2o, "g2o", false},
                                                 {Format::kPose, "pose", true},
                                                 {Format::kFrames, "frames", true}}};

/** \return the files of a folder with the extension, in natural order */
std::vector<fs::path>
filesWith(const std::string& extension, const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().extension() == extension &&
        entry->path().filename().string().front() != '.')
      files.push_back(entry->path());
  if (error)
    text::fail(folder, error.message());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturalLess(a.filename().string(), b.filename().string());
  });
  return files;
}

/** \return the format of the files in a folder */
Format
formatIn(const fs::path& folder)
{
  const bool poses = !filesWith(".pose", folder).empty();
  const bool frames = !filesWith(".frames", folder).empty();
  if (poses && frames)
    text::fail(folder, "holds .pose and .frames files; choose pose or frames");
  if (!poses && !frames)
    text::fail(folder, "holds no .pose and no .frames file");
  return poses ? Format::kPose : Format::kFrames;
}

Format
formatOf(const fs::path& path)
{
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? formatIn(path)
                                         : trajectoryFormatOfExtension(path);
}

TrajectoryFiles
readFolder(const fs::path& folder, Format format)
{
  const std::string extension = '.' + toString(format);
  TrajectoryFiles result;
  std::size_t earlier = 0;
  for (const auto& file : filesWith(extension, folder)) {
    result.names.push_back(file.stem().string());
    if (format == Format::kPose) {
      result.trajectory.poses.push_back(readUosPose(file));
      continue;
    }
    const std::vector<Frame> frames = readFrames(file);
    if (frames.empty())
      text::fail(file, "holds no pose");
    earlier += frames.size() - 1;
    result.trajectory.poses.push_back(frames.back().T_world_scan);
  }
  if (result.names.empty())
    text::fail(folder, "holds no " + extension + " file");
  if (earlier > 0)
    result.left_out.push_back(text::counted(earlier, "earlier pose") + " of the scans");
  return result;
}

TrajectoryFiles
readVertices(const fs::path& path)
{
  const PoseGraph graph = readPoseGraph(path);
  TrajectoryFiles result;
  std::vector<std::size_t> order(graph.poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!graph.ids.empty()) // programs write vertices in any order
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return graph.ids[a] < graph.ids[b];
    });
  for (const std::size_t i : order) {
    result.trajectory.poses.push_back(graph.poses[i]);
    if (!graph.ids.empty())
      result.trajectory.stamps.push_back(static_cast<double>(graph.ids[i]));
  }
  if (std::adjacent_find(result.trajectory.stamps.begin(),
                         result.trajectory.stamps.end()) !=
      result.trajectory.stamps.end()) { // too large for a double
    result.trajectory.stamps.clear();
    result.left_out.emplace_back("the ids of the vertices");
  }
  if (!graph.links.empty())
    result.left_out.push_back(text::counted(graph.links.size(), "edge"));
  return result;
}

/** Reads rows of the format, or of any. */
TrajectoryFiles
readRows(const fs::path& path, Format format)
{
  TrajectoryFiles result;
  result.trajectory = readTrajectory(path);
  result.format = result.trajectory.stamps.empty() ? Format::kKitti : Format::kTum;
  if (format != Format::kAuto && format != result.format)
    text::fail(path,
               "holds rows of " + toString(result.format) + ", not of " +
                   toString(format));
  return result;
}
} // namespace

Format
trajectoryFormatFromName(const std::string& name)
{
  for (const auto& known : kFormats)
    if (name == known.name)
      return known.format;
  throw BadArgument("format = " + text::quoted(name) +
                    ", but must be auto, kitti, tum, g2o, pose or frames");
}

std::string
toString(Format format)
{
  for (const auto& known : kFormats)
    if (known.format == format)
      return known.name;
  return {};
}

Format
trajectoryFormatOfExtension(const fs::path& path)
{
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& known : kFormats)
    if (!known.is_folder && known.format != Format::kAuto &&
        extension == std::string(".") + known.name)
      return known.format;
  return Format::kAuto;
}

bool
isFolder(Format format)
{
  return format == Format::kPose || format == Format::kFrames;
}

TrajectoryFiles
readTrajectoryFiles(const fs::path& path, Format format)
{
  if (format == Format::kAuto)
    format = formatOf(path);
  TrajectoryFiles result = isFolder(format)         ? readFolder(path, format)
                           : format == Format::kG2o ? readVertices(path)
                                                    : readRows(path, format);
  if (result.format == Format::kAuto)
    result.format = format;
  return result;
}

} // namespace pcl6d
