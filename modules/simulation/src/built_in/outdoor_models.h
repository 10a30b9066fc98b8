// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>
#include <pcl6d/simulation/terrain.h>

#include <cstdint>

/** \file Outdoor objects of the built-in scenes. Models stand on the origin of their
 * own frame, z up, x to their front; parts below reach into the ground. Houses stand on
 * the terrain of a scene. */
namespace pcl6d::simulation {

/** \brief A trunk and a crown with a rough outline. \param[in] height [m] */
TriangleScene
treeModel(double height, std::uint64_t seed);

/** \brief A street lamp, 5 m high, its arm to the front. */
TriangleScene
lampModel();

/** \brief A rectangle along the axes, seen from above [m]. */
struct Footprint {
  Eigen::Vector2d low, high;
};

/** \return a random rectangle within a rectangle, each side up to a quarter farther
 * in */
Footprint
randomFootprint(const Eigen::Vector2d& low,
                const Eigen::Vector2d& high,
                Random& random);

/** \brief Adds a house with pilasters and a flat roof, founded below the lowest corner
 * of its ground. \param[in] height [m] above the highest corner */
void
addHouse(TriangleScene& scene,
         const Terrain& terrain,
         const Footprint& plan,
         double height,
         Random& random);

} // namespace pcl6d::simulation
