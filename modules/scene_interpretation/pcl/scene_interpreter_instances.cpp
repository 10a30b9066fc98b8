// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/scene_interpretation/pcl/scene_interpreter.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(SceneInterpreter)
} // namespace pcl6d
