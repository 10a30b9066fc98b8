// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/offscreen.h"
#include "drawing/pixel_scene.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <cmath>

namespace pcl6d::visualization {

namespace {
/** \return the text with invalid UTF-8 replaced */
std::string
utf8From(const std::string& text)
{
  return nlohmann::json::parse(jsonText(text)).get<std::string>();
}

void
setColour(const Colour& from, double* to)
{
  for (std::size_t i = 0; i < from.size(); ++i)
    to[i] = from[i] / 255.0;
}
} // namespace

PixelScene::PixelScene(int width, int height, const Colour& background)
: width_(width), height_(height), background_(background), base_(width, height)
{
  renderer_->SetBackground(0, 0, 0);
  renderer_->SetBackgroundAlpha(0);
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * height);
  camera->SetFocalPoint(0.5 * width, 0.5 * height, 0);
  camera->SetPosition(0.5 * width, 0.5 * height, kTopLayer + 1);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(0.5, kTopLayer + 2);
}

PixelScene::~PixelScene() = default;

void
PixelScene::setBase(PixelLayer layer)
{
  base_ = std::move(layer);
}

void
PixelScene::addPoints(const std::vector<Eigen::Vector3f>& points,
                      const std::vector<Colour>& colours,
                      double size)
{
  if (!splats_)
    splats_ = std::make_unique<SplatBuffer>(width_, height_);
  const auto first = static_cast<std::uint32_t>(splat_colours_.size());
  splat_colours_.insert(splat_colours_.end(), colours.begin(), colours.end());
  constexpr std::size_t kPointsPerBlock = 1U << 16U;
  parallelBlocks(points.size(), kPointsPerBlock, 0, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      splats_->add(points[i].x(),
                   points[i].y(),
                   2 - points[i].z(), // any depth > 0 that decreases with the layer
                   static_cast<float>(size),
                   first + static_cast<std::uint32_t>(i));
  });
}

void
PixelScene::addShapes(const std::vector<Polyline>& shapes, bool filled, const Pen& pen)
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToFloat();
  vtkNew<vtkCellArray> cells;
  for (const auto& points : shapes) {
    cells->InsertNextCell(static_cast<int>(points.size()));
    for (const auto& p : points)
      cells->InsertCellPoint(
          places->InsertNextPoint(p.x(), height_ - p.y(), pen.layer));
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(places);
  if (filled)
    shape->SetPolys(cells);
  else
    shape->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* style = actor->GetProperty();
  double rgb[3];
  setColour(pen.colour, rgb);
  style->SetColor(rgb);
  style->LightingOff();
  style->SetLineWidth(static_cast<float>(pen.size));
  renderer_->AddActor(actor);
}

void
PixelScene::addLine(const Polyline& points, const Pen& pen)
{
  addLines({points}, pen);
}

void
PixelScene::addLines(const std::vector<Polyline>& lines, const Pen& pen)
{
  std::vector<Polyline> drawn;
  for (const auto& line : lines)
    if (line.size() >= 2)
      drawn.push_back(line);
  if (!drawn.empty())
    addShapes(drawn, false, pen);
}

void
PixelScene::addDisc(const Eigen::Vector2d& centre, const Pen& pen)
{
  addDiscs({centre}, pen);
}

void
PixelScene::addDiscs(const std::vector<Eigen::Vector2d>& centres, const Pen& pen)
{
  constexpr int kCorners = 32;
  std::vector<Polyline> circles;
  for (const auto& centre : centres) {
    Polyline& circle = circles.emplace_back();
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      circle.push_back(centre + 0.5 * pen.size *
                                    Eigen::Vector2d(std::cos(angle), -std::sin(angle)));
    }
  }
  if (!circles.empty())
    addShapes(circles, true, pen);
}

void
PixelScene::addText(const Eigen::Vector2d& place,
                    const std::string& text,
                    Align align,
                    const Pen& pen,
                    Turn turn)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(utf8From(text).c_str()); // VTK draws no text with invalid bytes
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
  vtkTextRenderer::GetInstance()->GetBoundingBox(
      style, utf8From(text), box, kDotsPerInch);
  return box[1] - box[0];
}

Image
PixelScene::draw(bool transparent)
{
  PixelLayer picture = base_;
  if (splats_)
    layOver(splats_->paint(splat_colours_, shading_), picture);
  layOver(drawOffscreen(renderer_, width_, height_), picture);
  return transparent ? onNothing(picture) : onBackground(picture, background_);
}

} // namespace pcl6d::visualization
