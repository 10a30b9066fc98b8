// SPDX-License-Identifier: BSD-3-Clause
// The private display on a bad day: a user's display, many at once, killed at any time.
#include "drawing.h"
#include "support/folders.h"
#include "support/temp_folder.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <X11/Xlib.h>
#include <cstdlib>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {
using namespace pcl6d::test;

/** The socket of a display on which somebody listens, but there is no X server. */
class ListeningDisplay {
public:
  ListeningDisplay()
  {
    fs::create_directories("/tmp/.X11-unix");
    file_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
    for (number_ = 4000; number_ < 4100; ++number_) {
      sockaddr_un address{};
      address.sun_family = AF_UNIX;
      path().copy(address.sun_path, sizeof(address.sun_path) - 1);
      if (::bind(file_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0)
        break;
    }
    ::listen(file_, 5);
  }
  ~ListeningDisplay()
  {
    ::close(file_);
    fs::remove(path());
  }
  ListeningDisplay(const ListeningDisplay&) = delete;
  ListeningDisplay&
  operator=(const ListeningDisplay&) = delete;

  std::string
  name() const
  {
    return ":" + std::to_string(number_);
  }
  bool
  wasCalled() const
  {
    return ::accept(file_, nullptr, nullptr) >= 0;
  }

private:
  std::string
  path() const
  {
    return "/tmp/.X11-unix/X" + std::to_string(number_);
  }

  int file_ = -1;
  int number_ = 0;
};

/** \return the X servers whose environment holds a variable, such as "NAME=value" */
std::vector<int>
serversWith(const std::string& variable)
{
  std::vector<int> pids;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0 && runs(pid) && readText(entry.path() / "comm") == "Xvfb\n" &&
        readText(entry.path() / "environ").find(variable) != std::string::npos)
      pids.push_back(pid);
  }
  return pids;
}
/** \return whether a process of a user without the key can connect to a display */
bool
canConnect(const std::string& display, uid_t user)
{
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("XAUTHORITY", "/dev/null", 1);
    if (::geteuid() != user &&
        (::setgid(static_cast<gid_t>(user)) != 0 || ::setuid(user) != 0))
      ::_exit(2);
    ::_exit(::XOpenDisplay(display.c_str()) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/** \return the file of the key as the server has it open */
fs::path
keyFileOf(int server)
{
  const std::string arguments =
      readText("/proc/" + std::to_string(server) + "/cmdline");
  const std::string option("-auth\0/proc/self/", 17);
  const std::size_t place = arguments.find(option);
  EXPECT_NE(place, std::string::npos) << arguments;
  return "/proc/" + std::to_string(server) + '/' +
         arguments.substr(place + option.size()).c_str();
}
} // namespace

TEST(PrivateDisplay, LetsNobodyInWithoutItsKey)
{
  const TempFolder folder;
  const Drawing drawing(folder / "a.png", "wait");
  ASSERT_GT(drawing.serverPid(), 0) << drawing.line();
  EXPECT_FALSE(canConnect(drawing.display(), ::geteuid()));
  constexpr uid_t kNobody = 65534;
  if (::geteuid() == 0) // the only one who can become somebody else
    EXPECT_FALSE(canConnect(drawing.display(), kNobody));
  else
    GTEST_SKIP() << "only root can try as another user";
}

TEST(PrivateDisplay, HasItsKeyInAFileThatNoOtherUserCanRead)
{
  const TempFolder folder;
  const Drawing first(folder / "a.png", "wait"), second(folder / "b.png", "wait");
  std::vector<std::string> keys;
  for (const int server : {first.serverPid(), second.serverPid()}) {
    struct stat status {};
    ASSERT_EQ(::stat(keyFileOf(server).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    EXPECT_EQ(status.st_uid, ::geteuid());
    keys.push_back(readText(keyFileOf(server)));
  }
  EXPECT_NE(keys[0].find("MIT-MAGIC-COOKIE-1"), std::string::npos);
  EXPECT_EQ(keys[0].size(), 44u) << "18 bytes of the name and 16 of the key";
  EXPECT_NE(keys[0], keys[1]);
  EXPECT_EQ(fs::read_symlink(keyFileOf(first.serverPid())).string().rfind("/memfd:", 0),
            0u)
      << "nothing can be left behind";
}

TEST(PrivateDisplay, ThatEndsWhileWeDrawIsAnErrorWithWords)
{
  const TempFolder folder;
  for (int i = 0; i < 10; ++i) {
    Drawing drawing(folder / "a.png", "go-on");
    ASSERT_GT(drawing.serverPid(), 0) << drawing.line();
    std::this_thread::sleep_for(std::chrono::milliseconds(37 * i));
    ::kill(drawing.serverPid(), SIGKILL);
    const std::string message = drawing.nextLine();
    EXPECT_EQ(drawing.wait(), 1);
    EXPECT_NE(message.find("cannot draw pictures: the private X server"),
              std::string::npos)
        << message;
    EXPECT_EQ(drawing.errors(), "") << "Xlib must not chat";
  }
}

TEST(PrivateDisplay, NeedsNoLocaleThatIsInstalled)
{
  const TempFolder folder;
  Drawing drawing(folder / "a.png", "end", environmentWith("LC_ALL", "xx_YY.UTF-8"));
  EXPECT_EQ(drawing.wait(), 0) << drawing.line();
  EXPECT_TRUE(fs::exists(folder / "a.png"));
}

TEST(PrivateDisplay, NeverCallsTheUsersDisplay)
{
  const ListeningDisplay users;
  const TempFolder folder;
  Drawing drawing(folder / "a.png", "end", environmentWith("DISPLAY", users.name()));
  EXPECT_EQ(drawing.wait(), 0) << drawing.line();
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  EXPECT_FALSE(users.wasCalled());
}

TEST(PrivateDisplay, ServesSeveralProcessesThatStartTogether)
{
  const TempFolder folder;
  std::vector<bp::child> started;
  for (int i = 0; i < 6; ++i)
    started.emplace_back(PCL6D_BUILD_DIR "/test/bin/draw_and_wait",
                         (folder / (std::to_string(i) + ".png")).string(),
                         "end",
                         bp::std_out > bp::null);
  for (auto& child : started) {
    child.wait();
    EXPECT_EQ(child.exit_code(), 0);
  }
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(fs::exists(folder / (std::to_string(i) + ".png"))) << i;
}

TEST(PrivateDisplay, LeavesNothingBehindWhenTheProcessIsKilledAtAnyTime)
{
  const TempFolder folder;
  const std::string mark = "PCL6D_TEST=" + folder.path().string();
  for (int i = 0; i < 10; ++i) {
    bp::child child(PCL6D_BUILD_DIR "/test/bin/draw_and_wait",
                    (folder / "a.png").string(),
                    "wait",
                    environmentWith("PCL6D_TEST", folder.path().string()),
                    bp::std_out > bp::null);
    std::this_thread::sleep_for(std::chrono::milliseconds(40 * i));
    ::kill(child.id(), SIGKILL);
    child.wait();
  }
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!serversWith(mark).empty() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(serversWith(mark).empty());
  for (const int pid : serversWith(mark)) // ours, and nobody else will
    ::kill(pid, SIGKILL);
}
