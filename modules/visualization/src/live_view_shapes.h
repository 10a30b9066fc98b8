// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <vtkBoundingBox.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <map>

class vtkActor;
class vtkPoints;
class vtkPolyData;
class vtkRenderer;

namespace pcl6d {

/** \return a shape in one colour, not lit */
vtkSmartPointer<vtkActor>
makeActor(vtkPolyData* shape, const double* colour);

/** \brief One cell through all points in order: of dots, or of a line. */
void
setPoints(vtkPolyData* shape, vtkPoints* places, bool line);

/** \return the box about most points: single ones far off do not count */
vtkBoundingBox
coreOf(const Points& points);

/** \brief A line through poses that come in any order. */
class LivePath {
public:
  LivePath(vtkRenderer* renderer, const double* colour);
  void
  set(std::uint32_t number, const Eigen::Matrix4d& pose);
  void
  update();

private:
  std::map<std::uint32_t, Eigen::Vector3d> places_;
  vtkNew<vtkPolyData> shape_;
};

} // namespace pcl6d
