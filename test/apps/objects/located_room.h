// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folders.h"
#include "support/run_program.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr const char* kObjectsProgram = "pcl_slam6d_objects";

/** \return the folder of a model of the store */
inline std::string
storedModel(const std::string& name)
{
  return std::string(PCL6D_SOURCE_DIR) + "/share/models/" + name;
}

/** \brief The folder "sim": two chairs and a table in an empty room, three scans with exact
 * poses and labels, in which each is seen several times. */
class LocatedRoom {
public:
  LocatedRoom()
  {
    writeText(folder_ / "scene.json", scene());
    const Outcome made = runProgram("pcl_slam6d_simulate",
                                    {(folder_ / "scene.json").string(),
                                     "-o",
                                     sim().string(),
                                     "--odometry",
                                     "exact",
                                     "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }

  std::filesystem::path
  sim() const
  {
    return folder_ / "sim";
  }
  std::string
  operator/(const std::string& name) const
  {
    return (folder_ / name).string();
  }

private:
  static std::string
  box(const std::string& centre, const std::string& size)
  {
    return R"({"type": "box", "centre": [)" + centre + R"(], "size": [)" + size + "]}";
  }
  static std::string
  object(const std::string& name, const std::string& position, const std::string& yaw)
  {
    return R"({"class": ")" + name + R"(", "file": ")" + storedModel(name) +
           R"(/model.ply", "position": [)" + position + R"(, 0], "yaw": )" + yaw + "}";
  }
  static std::string
  scene()
  {
    return R"({"scans": 3, "max_range": 20, "bodies": [)" +
           box("0, 0, -0.1", "7, 6, 0.2") + "," + box("0, 0, 2.6", "7, 6, 0.2") + "," +
           box("-3.6, 0, 1.25", "0.2, 6, 2.5") + "," +
           box("3.6, 0, 1.25", "0.2, 6, 2.5") + "," +
           box("0, -3.1, 1.25", "7, 0.2, 2.5") + "," +
           box("0, 3.1, 1.25", "7, 0.2, 2.5") + R"(], "objects": [)" +
           object("chair", "0.6, 1.6", "0.8") + "," +
           object("chair", "1.9, -0.8", "-2") + "," +
           object("table", "-0.9, -1.7", "0.3") +
           R"(], "waypoints": [[-1.5, 0, 0], [0.5, 0, 0], [0.6, 0.2, 0]]})";
  }

  TempFolder folder_;
};

} // namespace pcl6d::test
