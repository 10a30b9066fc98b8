// SPDX-License-Identifier: BSD-3-Clause
#include "offscreen.h"
#include "pixel_scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace pcl6d {

namespace {
void
setColour(const Colour& from, double* to)
{
  for (std::size_t i = 0; i < from.size(); ++i)
    to[i] = from[i] / 255.0;
}

/** One cell that visits all points in order: many points cost no memory for cells. */
vtkNew<vtkCellArray>
oneCell(vtkIdType count)
{
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i)
    cells->InsertCellPoint(i);
  return cells;
}
} // namespace

PixelScene::PixelScene(int width, int height, const Colour& background)
: width_(width), height_(height)
{
  double rgb[3];
  setColour(background, rgb);
  renderer_->SetBackground(rgb);
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * height);
  camera->SetFocalPoint(0.5 * width, 0.5 * height, 0);
  camera->SetPosition(0.5 * width, 0.5 * height, kTopLayer + 1);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(0.5, kTopLayer + 2);
}

PixelScene::~PixelScene() = default;

vtkActor*
PixelScene::addActor(vtkPolyData* shape)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  renderer_->AddActor(actor);
  return actor;
}

void
PixelScene::addPoints(const std::vector<Eigen::Vector3f>& points,
                      const std::vector<Colour>& colours,
                      double size)
{
  const auto count = static_cast<vtkIdType>(points.size());
  vtkNew<vtkPoints> places;
  places->SetDataTypeToFloat();
  places->SetNumberOfPoints(count);
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetNumberOfComponents(3);
  rgb->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto& p = points[static_cast<std::size_t>(i)];
    places->SetPoint(i, p.x(), static_cast<float>(height_) - p.y(), p.z());
    rgb->SetTypedTuple(i, colours[static_cast<std::size_t>(i)].data());
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(places);
  shape->SetVerts(oneCell(count));
  shape->GetPointData()->SetScalars(rgb);
  addActor(shape)->GetProperty()->SetPointSize(static_cast<float>(size));
}

vtkActor*
PixelScene::addShape(const std::vector<Eigen::Vector2d>& points,
                     bool filled,
                     const Pen& pen)
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToFloat();
  for (const auto& p : points)
    places->InsertNextPoint(p.x(), height_ - p.y(), pen.layer);
  const auto cells = oneCell(places->GetNumberOfPoints());
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(places);
  if (filled)
    shape->SetPolys(cells);
  else
    shape->SetLines(cells);
  vtkActor* actor = addActor(shape);
  double rgb[3];
  setColour(pen.colour, rgb);
  actor->GetProperty()->SetColor(rgb);
  return actor;
}

void
PixelScene::addLine(const std::vector<Eigen::Vector2d>& points, const Pen& pen)
{
  if (points.size() < 2)
    return;
  addShape(points, false, pen)
      ->GetProperty()
      ->SetLineWidth(static_cast<float>(pen.size));
}

void
PixelScene::addDisc(const Eigen::Vector2d& centre, const Pen& pen)
{
  constexpr int kCorners = 32;
  std::vector<Eigen::Vector2d> circle;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * M_PI * i / kCorners;
    circle.push_back(centre + 0.5 * pen.size *
                                  Eigen::Vector2d(std::cos(angle), -std::sin(angle)));
  }
  addShape(circle, true, pen);
}

void
PixelScene::addText(const Eigen::Vector2d& place,
                    const std::string& text,
                    Align align,
                    const Pen& pen,
                    Turn turn)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  vtkTextProperty* style = actor->GetTextProperty();
  double rgb[3];
  setColour(pen.colour, rgb);
  style->SetColor(rgb);
  style->SetFontSize(static_cast<int>(std::lround(pen.size)));
  style->SetVerticalJustificationToCentered();
  style->SetJustification(align == Align::kLeft     ? VTK_TEXT_LEFT
                          : align == Align::kCentre ? VTK_TEXT_CENTERED
                                                    : VTK_TEXT_RIGHT);
  if (turn == Turn::kUpwards)
    style->SetOrientation(90);
  actor->SetPosition(place.x(), height_ - place.y());
  renderer_->AddActor2D(actor);
}

double
PixelScene::textWidth(const std::string& text, double size)
{
  vtkNew<vtkTextProperty> style;
  style->SetFontSize(static_cast<int>(std::lround(size)));
  int box[4] = {0, 0, 0, 0};
  constexpr int kDotsPerInch = 72; // a point of text is a pixel
  vtkTextRenderer::GetInstance()->GetBoundingBox(style, text, box, kDotsPerInch);
  return box[1] - box[0];
}

Image
PixelScene::draw()
{
  return drawOffscreen(renderer_, width_, height_);
}

} // namespace pcl6d
