// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/options/settings.h"
#include "slam6d/output/planes_of_run.h"

#include <pcl6d/common/late_library.h>

namespace pcl6d::app {

WritePlanesOfRun&
planesOfRun()
{
#ifdef PCL6D_LATE_LIBRARIES
  static void* const address = symbolOfLateLibrary(
      std::string("--") + kPlanesOption, "pcl6d_planes_of_run", "pcl6d_planes_of_run");
  return *reinterpret_cast<WritePlanesOfRun*>(address);
#else
  return pcl6d_planes_of_run;
#endif
}

} // namespace pcl6d::app
