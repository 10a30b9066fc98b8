// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/live_view.h>

#include <memory>

namespace pcl6d::visualization {

/** \brief The window of a LiveView, in its own process. */
class LiveViewWindow {
public:
  /** \brief Opens it on the display that DISPLAY names.
   * \throws IoFailed it cannot be opened; where OpenGL is missing, VTK may also end the
   * process */
  explicit LiveViewWindow(const LiveViewOptions& options);
  ~LiveViewWindow();

  /** \brief Draws what comes in, until the user closes the window or the sender is gone. */
  void
  run(int socket);

private:
  class Scene;
  std::unique_ptr<Scene> scene_;
};

} // namespace pcl6d::visualization
