// SPDX-License-Identifier: BSD-3-Clause
// draw_and_wait FILE end|wait|kill-server|go-on
// Draws a picture, prints the process id and the name of its X server, then ends, waits
// for a signal, kills the server and tries once more, or draws until something is wrong.
// Errors go to stdout, too.
#include <pcl6d/visualization/private_display.h>
#include <pcl6d/visualization/top_view.h>

#include <iostream>
#include <signal.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

int
main(int, char** argv)
try {
  pcl6d::TopViewScene scene;
  for (int i = 0; i < 100; ++i)
    scene.points.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
  const std::string file = argv[1], then = argv[2];
  pcl6d::TopView().write(file, scene);
  const auto& display = pcl6d::PrivateDisplay::instance();
  std::cout << display.serverPid() << ' ' << display.name() << std::endl;
  if (then == "wait")
    ::pause();
  while (then == "go-on")
    pcl6d::TopView().write(file, scene);
  if (then == "kill-server") {
    ::kill(display.serverPid(), SIGKILL);
    siginfo_t ended; // wait, but leave it to the library to notice
    ::waitid(P_PID, static_cast<id_t>(display.serverPid()), &ended, WEXITED | WNOWAIT);
    pcl6d::TopView().write(file, scene);
  }
  return 0;
} catch (const std::exception& e) {
  std::cout << e.what() << std::endl;
  return 1;
}
