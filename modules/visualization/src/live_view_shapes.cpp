// SPDX-License-Identifier: BSD-3-Clause
#include "live_view_shapes.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace pcl6d {

vtkSmartPointer<vtkActor>
makeActor(vtkPolyData* shape, const double* colour)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  return actor;
}

void
setPoints(vtkPolyData* shape, vtkPoints* places, bool line)
{
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(places->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < places->GetNumberOfPoints(); ++i)
    cells->InsertCellPoint(i);
  shape->SetPoints(places);
  if (line)
    shape->SetLines(cells);
  else
    shape->SetVerts(cells);
}

vtkBoundingBox
coreOf(const Points& points)
{
  constexpr double kShare = 0.05; // left out at each side
  if (points.empty())
    return {};
  double low[3], high[3];
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [&](const auto& p) {
      return p[axis];
    });
    std::sort(values.begin(), values.end());
    const auto left_out =
        static_cast<std::size_t>(kShare * static_cast<double>(values.size() - 1));
    low[axis] = values[left_out];
    high[axis] = values[values.size() - 1 - left_out];
  }
  return {low[0], high[0], low[1], high[1], low[2], high[2]};
}

LivePath::LivePath(vtkRenderer* renderer, const double* colour)
{
  const auto actor = makeActor(shape_, colour);
  actor->GetProperty()->SetLineWidth(2);
  renderer->AddActor(actor);
}

void
LivePath::set(std::uint32_t number, const Eigen::Matrix4d& pose)
{
  places_[number] = pose.topRightCorner<3, 1>();
}

void
LivePath::update()
{
  vtkNew<vtkPoints> points;
  for (const auto& [number, place] : places_)
    points->InsertNextPoint(place.data());
  setPoints(shape_, points, true);
}

} // namespace pcl6d
