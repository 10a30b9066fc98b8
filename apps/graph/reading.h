// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/option_table.h"
#include "graph/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace pcl6d::app {

/** Adds the options for reading a graph. */
inline void
addReading(OptionTable& table, PoseGraphReaderOptions& options)
{
  table.add("skip-unknown", &options.skip_unknown)
      .help("leave out lines that are no poses, links, landmarks, priors or "
            "switches, in place of an error");
}

/** Warns of skipped lines. */
inline void
warnOfSkipped(const PoseGraphFile& file)
{
  for (const auto& lines : file.skipped)
    std::fprintf(stderr, "%s: warning: skipped %s\n", kGraph, lines.c_str());
}

/** Prints the numbers of landmarks, priors and switches, if any. */
inline void
printConstraints(const GraphConstraints& constraints)
{
  if (!constraints.landmarks.empty())
    std::printf("landmarks %zu sightings %zu\n",
                constraints.landmarks.size(),
                constraints.sightings.size());
  if (!constraints.priors.empty())
    std::printf("priors %zu\n", constraints.priors.size());
  const auto off = std::count_if(constraints.switches.begin(),
                                 constraints.switches.end(),
                                 [](const LinkSwitch& one) { return one.value < 0.5; });
  if (!constraints.switches.empty())
    std::printf("switches %zu off %td\n", constraints.switches.size(), off);
}

/** \throws IoFailed the output is TORO, which cannot represent the constraints of the file */
inline void
refuseConstraintsOfToro(const PoseGraphFile& file,
                        const std::string& output,
                        PoseGraphFormat format)
{
  if (formatToWrite(output, format) == PoseGraphFormat::kToro &&
      !file.constraints.isEmpty())
    throw IoFailed(output + ": TORO has no lines for landmarks, priors and switches; "
                            "write g2o");
}

} // namespace pcl6d::app
