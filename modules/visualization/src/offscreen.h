// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>

class vtkRenderer;

namespace pcl6d {

/** \brief Draws a VTK scene on the private display. One call at a time; others wait.
 * VTK's own messages are caught: errors are thrown, warnings dropped.
 * \throws IoFailed no private display, or OpenGL refused */
Image
drawOffscreen(vtkRenderer* renderer, int width, int height);

} // namespace pcl6d
