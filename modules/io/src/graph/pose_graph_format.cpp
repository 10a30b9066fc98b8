// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph_row.h"

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
               PoseGraphFormat format,
               const GraphConstraints& constraints)
{
  if (formatToWrite(path, format) != PoseGraphFormat::kToro)
    io::writeConstrainedG2o(path, graph, constraints);
  else if (constraints.isEmpty())
    writePoseGraphToro(path, graph);
  else
    throw BadArgument(
        "TORO has no lines for landmarks, priors and switches: write g2o");
}

} // namespace pcl6d
