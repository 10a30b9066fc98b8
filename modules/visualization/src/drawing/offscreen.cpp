// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/offscreen.h"
#include "drawing/x_connection.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/private_display.h>

#include <vtkCallbackCommand.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXOpenGLRenderWindow.h>

#include <algorithm>
#include <mutex>
#include <string>

namespace pcl6d::visualization {

namespace {
/** Catches messages of VTK within its scope, also its log on the terminal. */
class CaughtMessages {
public:
  CaughtMessages()
  : before_(vtkOutputWindow::GetInstance())
  , verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
  {
    vtkOutputWindow::SetInstance(caught_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~CaughtMessages()
  {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  CaughtMessages(const CaughtMessages&) = delete;
  CaughtMessages&
  operator=(const CaughtMessages&) = delete;

  /** \return the text of the first error, on one line; empty without error */
  std::string
  firstError()
  {
    std::string text = caught_->GetOutput();
    const auto begin = text.find("ERROR:");
    if (begin == std::string::npos)
      return {};
    text = text.substr(begin, text.find("\n\n", begin) - begin);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }

private:
  vtkNew<vtkStringOutputWindow> caught_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
};

/** Limits VTK to one thread within its scope: without resources for more threads VTK
 * would end the process. */
class OneThread {
public:
  OneThread() : before_(vtkSMPTools::GetBackend())
  {
    vtkSMPTools::SetBackend("Sequential");
  }
  ~OneThread() { vtkSMPTools::SetBackend(before_.c_str()); }
  OneThread(const OneThread&) = delete;
  OneThread&
  operator=(const OneThread&) = delete;

private:
  std::string before_;
};

[[noreturn]] void
failWithoutOpenGl()
{
  throw IoFailed("cannot draw pictures: no OpenGL: install the driver of Mesa "
                 "(libgl1-mesa-dri), or free some memory");
}

/** Throws in cases where VTK would end the process: no visual, or, later, no context
 * while no observer listens. */
void
requireOpenGl(vtkXOpenGLRenderWindow* window)
{
  vtkNew<vtkCallbackCommand> listener;
  listener->SetCallback(
      [](vtkObject*, unsigned long, void*, void*) { failWithoutOpenGl(); });
  window->AddObserver(vtkCommand::ExitEvent, listener);
  auto* const visual = window->GetDesiredVisualInfo();
  if (!visual)
    failWithoutOpenGl();
  ::XFree(visual);
}

PixelLayer
readPixels(vtkRenderWindow* window, int width, int height)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetRGBACharPixelData(0, 0, width - 1, height - 1, /*front=*/0, pixels);
  PixelLayer layer(width, height);
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
  const std::size_t size = layer.rgba.size();
  if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != size)
    throw IoFailed("cannot draw pictures: OpenGL gave no pixels");
  const std::uint8_t* source = pixels->GetPointer(0); // rows from below
  for (std::size_t begin = 0; begin < size; begin += row_bytes)
    std::copy_n(source + begin, row_bytes, &layer.rgba[size - row_bytes - begin]);
  return layer;
}

PixelLayer
render(vtkRenderer* renderer, vtkXOpenGLRenderWindow* window, int width, int height)
try {
  const PrivateDisplay& display = PrivateDisplay::instance();
  window->SetDisplayId(display.connection());
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->SetMultiSamples(4);
  window->SetAlphaBitPlanes(1);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  const EndIsThrown scope;
  waitForAnswer(
      static_cast<_XDisplay*>(display.connection())); // a dead display has no OpenGL
  display.requireAlive();
  requireOpenGl(window);
  window->Render();
  PixelLayer layer = readPixels(window, width, height);
  window->RemoveRenderer(renderer);
  window->Finalize();
  waitForAnswer(static_cast<_XDisplay*>(display.connection()));
  display.requireAlive();
  return layer;
} catch (...) {
  // never destroyed: destruction would send requests to the server
  window->Register(nullptr);
  renderer->Register(nullptr);
  throw;
}
} // namespace

PixelLayer
drawOffscreen(vtkRenderer* renderer, int width, int height)
{
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  CaughtMessages messages;
  const OneThread one_thread;
  vtkNew<vtkXOpenGLRenderWindow> window;
  PixelLayer layer = render(renderer, window, width, height);
  const std::string error = messages.firstError();
  if (!error.empty())
    throw IoFailed("cannot draw pictures: VTK says: " + error);
  return layer;
}

} // namespace pcl6d::visualization
