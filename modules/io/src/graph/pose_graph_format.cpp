// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/io/pose_graph_io.h>

#include <cctype>

namespace pcl6d {

namespace {
constexpr Named<PoseGraphFormat> kGraphFormats[] = {{PoseGraphFormat::kAuto, "auto"},
                                                    {PoseGraphFormat::kG2o, "g2o"},
                                                    {PoseGraphFormat::kToro, "toro"}};
} // namespace

PoseGraphFormat
poseGraphFormatFromName(const std::string& name)
{
  return fromName(kGraphFormats, "format", name);
}

std::string
toString(PoseGraphFormat format)
{
  return nameOf(kGraphFormats, format);
}

PoseGraphFormat
formatToWrite(const std::filesystem::path& path, PoseGraphFormat format)
{
  if (format != PoseGraphFormat::kAuto)
    return format;
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".graph" || extension == ".toro" ? PoseGraphFormat::kToro
                                                       : PoseGraphFormat::kG2o;
}

void
writePoseGraph(const std::filesystem::path& path,
               const PoseGraph& graph,
               PoseGraphFormat format)
{
  if (formatToWrite(path, format) == PoseGraphFormat::kToro)
    writePoseGraphToro(path, graph);
  else
    writePoseGraphG2o(path, graph);
}

} // namespace pcl6d
