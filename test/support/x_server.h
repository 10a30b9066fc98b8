// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/process.hpp>

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

// Macros of Xlib that are names elsewhere.
#undef Bool
#undef None
#undef Status
#undef Success

namespace pcl6d::test {

/** \brief An X server in the place of a user's display, looked at from outside. */
class XServer {
public:
  using Colour = std::array<int, 3>;

  XServer()
  : process_("/usr/bin/Xvfb",
             "-displayfd",
             "1",
             "-nolisten",
             "tcp",
             "-screen",
             "0",
             "1280x800x24",
             boost::process::std_out > output_,
             boost::process::std_err > boost::process::null)
  {
    std::string number;
    std::getline(output_, number);
    name_ = ":" + number;
    display_ = ::XOpenDisplay(name_.c_str());
    ::XSetErrorHandler([](Display*, XErrorEvent*) { return 0; }); // windows come and go
  }
  ~XServer()
  {
    if (display_)
      ::XCloseDisplay(display_);
    process_.terminate();
  }
  XServer(const XServer&) = delete;
  XServer&
  operator=(const XServer&) = delete;

  const std::string&
  name() const
  {
    return name_;
  }

  /** \return the windows that are seen, but not those of the server */
  std::vector<Window>
  windows() const
  {
    Window root = 0, parent = 0, *children = nullptr;
    unsigned int count = 0;
    std::vector<Window> seen;
    if (!::XQueryTree(display_,
                      ::XDefaultRootWindow(display_),
                      &root,
                      &parent,
                      &children,
                      &count))
      return seen;
    for (unsigned int i = 0; i < count; ++i) {
      XWindowAttributes attributes;
      if (::XGetWindowAttributes(display_, children[i], &attributes) &&
          attributes.map_state == IsViewable)
        seen.push_back(children[i]);
    }
    if (children)
      ::XFree(children);
    return seen;
  }

  std::string
  titleOf(Window window) const
  {
    char* name = nullptr;
    if (!::XFetchName(display_, window, &name) || !name)
      return {};
    std::string title = name;
    ::XFree(name);
    return title;
  }

  /** \return how many pixels of the screen fulfil a condition */
  std::size_t
  count(const std::function<bool(const Colour&)>& condition) const
  {
    XImage* image = ::XGetImage(
        display_, ::XDefaultRootWindow(display_), 0, 0, 1280, 800, AllPlanes, ZPixmap);
    std::size_t number = 0;
    for (int row = 0; row < image->height; ++row)
      for (int column = 0; column < image->width; ++column) {
        const unsigned long pixel = XGetPixel(image, column, row);
        number += condition({static_cast<int>(pixel >> 16 & 255),
                             static_cast<int>(pixel >> 8 & 255),
                             static_cast<int>(pixel & 255)});
      }
    XDestroyImage(image);
    return number;
  }

  /** \brief Asks a window to close, as the cross in its corner does. */
  void
  close(Window window) const
  {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = ::XInternAtom(display_, "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] =
        static_cast<long>(::XInternAtom(display_, "WM_DELETE_WINDOW", False));
    ::XSendEvent(display_, window, False, NoEventMask, &event);
    ::XSync(display_, False);
  }

  /** \brief Cuts the client of a window off, as xkill does. */
  void
  cutOff(Window window) const
  {
    ::XKillClient(display_, window);
    ::XSync(display_, False);
  }

private:
  boost::process::ipstream output_;
  boost::process::child process_;
  std::string name_;
  Display* display_ = nullptr;
};

/** \return whether a condition comes true within a time that suits a busy machine */
inline bool
soon(const std::function<bool()>& condition)
{
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

} // namespace pcl6d::test
