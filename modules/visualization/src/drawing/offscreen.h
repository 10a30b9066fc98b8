// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/pixel_layer.h"

class vtkRenderer;

namespace pcl6d::visualization {

/** \brief Draws a VTK scene on the private display with a transparent background; the
 * renderer's background must be black and without alpha. One call at a time; further
 * calls wait. Messages of VTK are caught: errors are thrown, warnings dropped.
 * \throws IoFailed no private display, or OpenGL failed */
PixelLayer
drawOffscreen(vtkRenderer* renderer, int width, int height);

} // namespace pcl6d::visualization
