// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/object_localization/object_symmetry.h>

#include <Eigen/Geometry>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The surface of an object in its own frame, complete or as far as scanned.
 * \ingroup object_localization */
class ObjectModel {
public:
  /** [m] A larger diameter hints at a model that is not in metres. */
  static constexpr double kLargestDiameter = 50;

  /** \brief Takes a cloud. Missing normals are estimated and oriented outwards
   * (orientNormals()).
   * \param[in] object_class for example "chair"
   * \param[in] points [m] in the object's frame; points with a non-finite coordinate
   * are left out
   * \param[in] normals one per point, or empty
   * \throws BadArgument fewer than 10 finite points, every point on one line, normals
   * neither empty nor one per point, or larger than kLargestDiameter (is it in
   * millimetres?) */
  static ObjectModel
  fromCloud(const std::string& object_class,
            const Points& points,
            const Normals& normals = {});

  /** \brief Takes a mesh: its surface is sampled evenly, about 100 points along its
   * diameter. The orientation of the triangles does not matter.
   * \throws BadArgument the mesh has no triangle or no area, or see fromCloud() */
  static ObjectModel
  fromMesh(const std::string& object_class, const TriangleMesh& mesh);

  const std::string&
  objectClass() const
  {
    return class_;
  }

  /** \return the surface with normals to the outside */
  const OrientedPoints&
  surface() const
  {
    return surface_;
  }

  /** \return the symmetry; default: no symmetry */
  const ObjectSymmetry&
  symmetry() const
  {
    return symmetry_;
  }
  void
  setSymmetry(const ObjectSymmetry& symmetry)
  {
    symmetry_ = symmetry;
  }

  /** \return [m] in the object's frame */
  const Eigen::AlignedBox3d&
  box() const
  {
    return box_;
  }

  /** \return the diagonal of the box [m] */
  double
  diameter() const
  {
    return box_.diagonal().norm();
  }

private:
  ObjectModel(const std::string& object_class, OrientedPoints surface);

  std::string class_;
  OrientedPoints surface_;
  Eigen::AlignedBox3d box_;
  ObjectSymmetry symmetry_;
};

} // namespace pcl6d
