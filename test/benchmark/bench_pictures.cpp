// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"

#include <pcl6d/common/random.h>
#include <pcl6d/visualization/map_view.h>
#include <pcl6d/visualization/private_display.h>
#include <pcl6d/visualization/top_view.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXOpenGLRenderWindow.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sys/resource.h>

namespace pcl6d::benchmarks {

namespace {
constexpr char kPeer[] = "vtkPolyDataMapper";
constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

/** Ground of 100 m x 60 m with blocks, as a map of a campus. */
MapViewScene
campus(std::size_t count)
{
  Random random(1);
  MapViewScene scene;
  scene.points.reserve(count);
  while (scene.points.size() < count) {
    const double x = random.uniform(0, 100), y = random.uniform(0, 60);
    const double u = x - 20 * std::floor(x / 20), v = y - 20 * std::floor(y / 20);
    const bool on_block = u > 6 && u < 14 && v > 6 && v < 14;
    const bool on_wall = std::abs(u - 6) < 0.5 && v > 6 && v < 14;
    const double z = on_wall ? random.uniform(0, 8) : on_block ? 8.0 : 0.0;
    scene.points.emplace_back(
        static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }
  return scene;
}

double
peakMemoryMb()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/** The share of pixels that are not background. */
double
filledShare(const std::vector<std::uint8_t>& bytes)
{
  std::size_t filled = 0;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3)
    filled += std::max({bytes[i], bytes[i + 1], bytes[i + 2]}) > 40;
  return 3 * static_cast<double>(filled) / static_cast<double>(bytes.size());
}

/** The same points from the same place by VTK's own points, coloured one by one. */
std::vector<std::uint8_t>
drawByVtk(const Points& points, const Camera& camera)
{
  vtkNew<vtkPoints> places;
  places->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  vtkNew<vtkUnsignedCharArray> rgb;
  rgb->SetNumberOfComponents(3);
  rgb->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto id = static_cast<vtkIdType>(i);
    const auto green = static_cast<std::uint8_t>(60 + 20 * points[i].z());
    const std::uint8_t colour[] = {80, green, 120};
    places->SetPoint(id, points[i].x(), points[i].y(), points[i].z());
    rgb->SetTypedTuple(id, colour);
    cells->InsertCellPoint(id);
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(places);
  shape->SetVerts(cells);
  shape->GetPointData()->SetScalars(rgb);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetPointSize(2);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const Eigen::Isometry3d& pose = camera.T_world_camera;
  const Eigen::Vector3d eye = pose.translation(),
                        ahead = pose * Eigen::Vector3d(0, 0, 10);
  renderer->GetActiveCamera()->SetPosition(eye.x(), eye.y(), eye.z());
  renderer->GetActiveCamera()->SetFocalPoint(ahead.x(), ahead.y(), ahead.z());
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->GetActiveCamera()->SetViewAngle(
      2 * std::atan(0.5 * kHeight / camera.scale) * 180 / M_PI);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkXOpenGLRenderWindow> window;
  window->SetDisplayId(PrivateDisplay::instance().connection());
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->SetSize(kWidth, kHeight);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  vtkRenderWindow* const drawn = window; // whose overload takes an array
  drawn->GetPixelData(0, 0, kWidth - 1, kHeight - 1, 0, pixels);
  return {pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues()};
}

struct Data {
  explicit Data(std::size_t count) : scene(campus(count))
  {
    options.width = kWidth;
    options.height = kHeight;
    options.max_points = count;
    camera = MapView(options).viewpoints(scene, 1).front();
  }
  MapViewScene scene;
  MapViewOptions options;
  Camera camera;
  Image ours;
  std::vector<std::uint8_t> theirs;
  double peak_memory_mb = 0; ///< of ours; VTK has not drawn points by then
};

PeerJob
pictureJob(std::size_t count)
{
  const auto data = std::make_shared<Data>(count);
  const auto drawOurs = [=] {
    data->ours = MapView(data->options).draw(data->scene, data->camera).image;
    if (data->peak_memory_mb == 0)
      data->peak_memory_mb = peakMemoryMb();
  };
  const auto check = [=](benchmark::State& state) {
    const double ours = filledShare(data->ours.rgb), theirs = filledShare(data->theirs);
    state.counters["ours_filled"] = ours;
    state.counters["peer_filled"] = theirs;
    state.counters["ours_peak_MB"] = data->peak_memory_mb;
    if (!(ours > 0.3 && std::abs(ours - theirs) < 0.15))
      state.SkipWithError("the pictures show different things");
  };
  return {drawOurs,
          [=] { data->theirs = drawByVtk(data->scene.points, data->camera); },
          check};
}
} // namespace

} // namespace pcl6d::benchmarks

int
main(int argc, char** argv)
{
  using namespace pcl6d::benchmarks;
  for (const std::size_t count : {1000000, 10000000})
    addPeerCase({"picture_1920x1080/" + std::to_string(count), kPeer, 0, 3, [=] {
                   return pictureJob(count);
                 }});
  return runPeerCases(argc, argv);
}
