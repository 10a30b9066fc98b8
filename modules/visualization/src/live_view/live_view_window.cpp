// SPDX-License-Identifier: BSD-3-Clause
#include "live_view/live_view_channel.h"
#include "live_view/live_view_window.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/map_overlays.h>

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkXOpenGLRenderWindow.h>
#include <vtkXRenderWindowInteractor.h>

#include <X11/Xlib.h>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <unistd.h>
#include <utility>

namespace pcl6d::visualization {
namespace {
constexpr int kInterval = 50; // [ms] between looks for messages
constexpr double kBackground[3] = {0.09, 0.10, 0.12};
constexpr double kWhite[3] = {1, 1, 1};
constexpr double kOrange[3] = {1, 0.6, 0.1};

/** \return a shape in a single colour, unlit */
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

/** One cell through the points in order: dots, or a line. */
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

/** \return the bounding box of most points, without isolated far points */
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

/** A line through poses received in any order. */
class LivePath {
public:
  LivePath(vtkRenderer* renderer, const double* colour)
  {
    const auto actor = makeActor(shape_, colour);
    actor->GetProperty()->SetLineWidth(2);
    renderer->AddActor(actor);
  }

  void
  set(std::uint32_t number, const Eigen::Matrix4d& pose)
  {
    places_[number] = pose.topRightCorner<3, 1>();
  }

  void
  update()
  {
    vtkNew<vtkPoints> points;
    for (const auto& [number, place] : places_)
      points->InsertNextPoint(place.data());
    setPoints(shape_, points, true);
  }

private:
  std::map<std::uint32_t, Eigen::Vector3d> places_;
  vtkNew<vtkPolyData> shape_;
};

/** Receives messages at once, so that the sender never waits for drawing. */
class Inbox {
public:
  explicit Inbox(int socket)
  {
    std::thread([this, socket] { fill(socket); }).detach();
  }

  std::deque<LiveMessage>
  takeAll()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(messages_, {});
  }
  bool
  isOver() const
  {
    return over_;
  }

private:
  void
  fill(int socket)
  {
    while (auto message = receiveMessage(socket)) {
      const std::lock_guard<std::mutex> lock(mutex_);
      messages_.push_back(*std::move(message));
    }
    over_ = true;
  }

  std::mutex mutex_;
  std::deque<LiveMessage> messages_;
  std::atomic<bool> over_{false};
};
} // namespace

class LiveViewWindow::Scene {
public:
  explicit Scene(const LiveViewOptions& options)
  : after_(renderer_, kWhite), before_(renderer_, kOrange)
  {
    renderer_->SetBackground(kBackground[0], kBackground[1], kBackground[2]);
    text_->GetTextProperty()->SetFontSize(20);
    text_->SetPosition(16, 14);
    renderer_->AddActor2D(text_);
    window_->SetWindowName(options.title.c_str());
    window_->SetSize(options.width, options.height);
    window_->AddRenderer(renderer_);
    interactor_->SetRenderWindow(window_);
    vtkNew<vtkInteractorStyleTrackballCamera> style;
    interactor_->SetInteractorStyle(style);
    setUpCamera();
    interactor_->Initialize();
    window_->Render();
  }

  void
  run(int socket)
  {
    Inbox inbox(socket);
    inbox_ = &inbox;
    listen(interactor_, vtkCommand::TimerEvent, [](Scene* scene) { scene->onTimer(); });
    const auto takeOver = [](Scene* scene) { scene->user_steers_ = true; };
    listen(interactor_, vtkCommand::LeftButtonPressEvent, takeOver);
    listen(interactor_, vtkCommand::MiddleButtonPressEvent, takeOver);
    listen(interactor_, vtkCommand::RightButtonPressEvent, takeOver);
    listen(interactor_, vtkCommand::MouseWheelForwardEvent, takeOver);
    listen(interactor_, vtkCommand::MouseWheelBackwardEvent, takeOver);
    interactor_->CreateRepeatingTimer(kInterval);
    interactor_->Start();
    ::_exit(0); // the thread of the inbox still waits
  }

private:
  using Handler = void (*)(Scene*);

  void
  listen(vtkObject* object, unsigned long event, Handler handler)
  {
    vtkNew<vtkCallbackCommand> command;
    handlers_[event] = handler;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long what, void* self, void*) {
      auto* scene = static_cast<Scene*>(self);
      scene->handlers_.at(what)(scene);
    });
    object->AddObserver(event, command);
  }

  /** Looks from the south, obliquely down. */
  void
  setUpCamera()
  {
    vtkCamera* camera = renderer_->GetActiveCamera();
    camera->SetFocalPoint(0, 0, 0);
    camera->SetPosition(0, -1, 1.2);
    camera->SetViewUp(0, 0, 1);
  }

  void
  onTimer()
  {
    const auto messages = inbox_->takeAll();
    if (messages.empty() && inbox_->isOver()) {
      interactor_->TerminateApp();
      return;
    }
    if (messages.empty())
      return;
    for (const auto& message : messages)
      take(message);
    after_.update();
    before_.update();
    if (!user_steers_)
      followMap();
    renderer_->ResetCameraClippingRange();
    window_->Render();
  }

  /** Shows the scans that have a pose. */
  void
  followMap()
  {
    vtkBoundingBox map;
    for (const auto& [number, scan] : scans_)
      if (scan.actor->GetVisibility())
        for (int corner = 0; corner < 8 && scan.core.IsValid(); ++corner) {
          double place[4] = {0, 0, 0, 1};
          scan.core.GetCorner(corner, place);
          scan.actor->GetUserMatrix()->MultiplyPoint(place, place);
          map.AddPoint(place);
        }
    double bounds[6];
    map.GetBounds(bounds);
    if (map.IsValid())
      renderer_->ResetCamera(bounds);
    else
      renderer_->ResetCamera();
  }

  void
  take(const LiveMessage& message)
  {
    switch (message.kind) {
    case LiveMessage::Kind::kText:
      text_->SetInput(message.text.c_str());
      break;
    case LiveMessage::Kind::kScan:
      before_.set(message.scan, message.T_world_scan);
      addScan(message);
      break;
    case LiveMessage::Kind::kPose:
      after_.set(message.scan, message.T_world_scan);
      placeScan(message);
    }
  }

  void
  addScan(const LiveMessage& message)
  {
    vtkNew<vtkPoints> places;
    places->SetDataTypeToFloat();
    for (const auto& p : message.points)
      places->InsertNextPoint(p.x(), p.y(), p.z());
    vtkNew<vtkPolyData> shape;
    setPoints(shape, places, false);
    const Colour colour = distinctColour(message.scan);
    const double rgb[3] = {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0};
    const auto actor = makeActor(shape, rgb);
    actor->GetProperty()->SetPointSize(2);
    actor->VisibilityOff();
    renderer_->AddActor(actor);
    scans_[message.scan] = {actor, coreOf(message.points)};
  }

  void
  placeScan(const LiveMessage& message)
  {
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        matrix->SetElement(row, column, message.T_world_scan(row, column));
    vtkActor* actor = scans_.at(message.scan).actor;
    actor->SetUserMatrix(matrix);
    actor->VisibilityOn();
  }

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkXOpenGLRenderWindow> window_;
  vtkNew<vtkXRenderWindowInteractor> interactor_;
  vtkNew<vtkTextActor> text_;
  LivePath after_;
  LivePath before_;
  struct Scan {
    vtkSmartPointer<vtkActor> actor;
    vtkBoundingBox core;
  };
  std::map<std::uint32_t, Scan> scans_;
  std::map<unsigned long, Handler> handlers_;
  Inbox* inbox_ = nullptr;
  bool user_steers_ = false; ///< the view no longer follows the map
};

LiveViewWindow::LiveViewWindow(const LiveViewOptions& options)
{
  // Xlib's own handler would run exit handlers of the parent process.
  ::XSetIOErrorHandler([](Display*) -> int { ::_exit(1); });
  ::XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  Display* display = ::XOpenDisplay(nullptr);
  if (!display)
    throw IoFailed("the display cannot be opened");
  ::XCloseDisplay(display);
  scene_ = std::make_unique<Scene>(options);
}

LiveViewWindow::~LiveViewWindow() = default;

void
LiveViewWindow::run(int socket)
{
  scene_->run(socket);
}

} // namespace pcl6d::visualization
