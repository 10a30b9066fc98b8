// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folders.h"

#include <boost/process.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <signal.h>
#include <sstream>
#include <string>
#include <thread>

/** \file The program draw_and_wait and its X server, seen from outside. */
namespace pcl6d::test {

namespace bp = boost::process;
namespace fs = std::filesystem;

inline constexpr std::chrono::seconds
    kPatience(10); // for a server to end on a busy machine

/** Whether a process runs; one that nobody has waited for (a zombie) does not. */
inline bool
runs(int pid)
{
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string word, state;
  return static_cast<bool>(stat >> word >> word >> state) && state != "Z";
}

inline bool
endsSoon(int pid)
{
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (runs(pid) && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return !runs(pid);
}

inline bp::environment
environmentWith(const std::string& name, const std::string& value)
{
  bp::environment environment = boost::this_process::environment();
  environment[name] = value;
  return environment;
}

/** A draw_and_wait process and the first line that it says. */
class Drawing {
public:
  Drawing(const fs::path& picture,
          const std::string& then,
          const bp::environment& environment = boost::this_process::environment())
  : process_(PCL6D_BUILD_DIR "/test/bin/draw_and_wait",
             picture.string(),
             then,
             environment,
             bp::std_out > output_,
             bp::std_err > errors_)
  {
    std::getline(output_, line_);
    std::istringstream(line_) >> server_pid_ >> display_;
  }
  ~Drawing() { end(SIGKILL); }
  Drawing(const Drawing&) = delete;
  Drawing&
  operator=(const Drawing&) = delete;

  void
  end(int signal)
  {
    if (process_.valid() && process_.running())
      ::kill(process_.id(), signal);
    wait();
  }
  int
  wait()
  {
    std::error_code ignored;
    process_.wait(ignored);
    return process_.exit_code();
  }
  std::string
  nextLine()
  {
    std::string line;
    std::getline(output_, line);
    return line;
  }
  std::string
  errors()
  {
    return {std::istreambuf_iterator<char>(errors_), {}};
  }
  int
  pid() const
  {
    return process_.id();
  }
  int
  serverPid() const
  {
    return server_pid_;
  }
  const std::string&
  display() const
  {
    return display_;
  }
  const std::string&
  line() const
  {
    return line_;
  }

private:
  bp::ipstream output_;
  bp::ipstream errors_;
  bp::child process_;
  std::string line_;
  int server_pid_ = 0;
  std::string display_;
};

inline fs::path
lockFile(const Drawing& drawing)
{
  return "/tmp/.X" + drawing.display().substr(1) + "-lock";
}

} // namespace pcl6d::test
