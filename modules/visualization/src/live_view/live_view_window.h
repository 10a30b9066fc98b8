// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/live_view.h>

#include <memory>

namespace pcl6d::visualization {

/** \brief The window of a LiveView, in its own process. */
class LiveViewWindow {
public:
  /** \brief Opens the window on the display named by DISPLAY.
   * \throws IoFailed the window cannot be opened; without OpenGL, VTK may also end the
   * process */
  explicit LiveViewWindow(const LiveViewOptions& options);
  ~LiveViewWindow();

  /** \brief Draws received messages, until the user closes the window or the sender ends. */
  void
  run(int socket);

private:
  class Scene;
  std::unique_ptr<Scene> scene_;
};

} // namespace pcl6d::visualization
