// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/splat_buffer.h"

#include <pcl6d/visualization/map_view.h>

namespace pcl6d::visualization {

/** \brief Draws points seen by a camera, each as large as the distance to its
 * neighbours.
 * \param[in] indices of the points; position i in this list is the index of the colour
 * \param[in] size in mean distances of neighbours */
void
addSplats(const Points& points,
          const std::vector<std::size_t>& indices,
          const Camera& camera,
          const PictureBox& box,
          double size,
          SplatBuffer& buffer);

/** \brief Draws the triangles of models as dense points.
 * \param[in,out] colours gets the colours of the models, shaded by the slope of their faces */
void
addModels(const std::vector<MapViewScene::Model>& models,
          const Camera& camera,
          std::vector<Colour>& colours,
          SplatBuffer& buffer);

/** \return the distance to the neighbours on the surface [m], one per index */
std::vector<float>
localSpacing(const Points& points, const std::vector<std::size_t>& indices);

} // namespace pcl6d::visualization
