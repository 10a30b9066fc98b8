// SPDX-License-Identifier: BSD-3-Clause
#include "option_words.h"

#include <pcl6d/common/option_spec.h>
#include <pcl6d/slam6d/slam6d_result.h>

namespace pcl6d {

void
describe(PreprocessOptions& o, Slam6DParameters& used, OptionList& list)
{
  list.stage(OptionStage::kPreprocess);
  list.group("Filters and reduction");
  describe(o, static_cast<ScanParameters&>(used), list);
  list.add("planar-rows", o.planar_rows)
      .inUnit("m")
      .within(finiteFrom0())
      .derivedAs("for a folder of scans by a 2D scanner, the larger of twice the point "
                 "spacing and 1/1.3 of a voxel; else 0",
                 used.planar_rows)
      .withHelp(
          "[m] or auto: a scan of a 2D scanner is copied upwards and downwards with "
          "this spacing, and registered in the plane of the first scan; 0: never");
  list.addChoice("reduction", o.reduction, reductionMethodFromName)
      .withHelp(slam6d::withBars(reductionMethodNames()) +
                ": the point that represents a voxel: the mean of the points, the "
                "centre of the voxel, or --reduction-points points chosen at random");
  list.add("reduction-points N", o.reduction_points)
      .within(from1())
      .countsIf([&o] { return o.reduction == ReductionMethod::kRandom; },
                "of --reduction random")
      .withHelp("points of a voxel, of --reduction random");
}

} // namespace pcl6d
