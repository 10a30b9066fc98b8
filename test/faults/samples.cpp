// SPDX-License-Identifier: BSD-3-Clause
#include "child.h"
#include "sample_texts.h"
#include "samples.h"
#include "support/temp_folder.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/** Runs programs in the folder of the samples. */
class Maker {
public:
  Maker(const fs::path& programs, const fs::path& folder)
  : programs_(programs), folder_(folder)
  {}

  /** \throws std::runtime_error it fails (3: done, with doubts) */
  void
  operator()(const std::string& program, const std::string& line) const
  {
    Command command;
    command.program = programs_ / program;
    std::istringstream stream(line);
    for (std::string word; stream >> word;)
      command.arguments.push_back(word);
    command.folder = folder_;
    command.out = folder_ / "out.log";
    command.err = folder_ / "err.log";
    command.temporary = folder_;
    Limits limits;
    limits.seconds = 120;
    const Ended end = runToEnd(command, limits);
    if (end.signal != 0 || (end.exit_code != 0 && end.exit_code != 3))
      throw std::runtime_error("no samples: " + shellLine(command) + ": " +
                               test::readText(command.err));
  }

private:
  const fs::path& programs_;
  const fs::path& folder_;
};

/** \return a unit cube of twelve triangles, as binary STL */
std::string
cubeStl()
{
  std::string bytes(80, ' ');
  const auto add = [&bytes](const auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(std::uint32_t{12});
  for (int face = 0; face < 6; ++face)
    for (const bool upper : {false, true}) {
      const int axis = face / 2;
      for (int i = 0; i < 3; ++i)
        add(i == axis ? (face % 2 ? 1.0F : -1.0F) : 0.0F);
      for (int corner = 0; corner < 3; ++corner)
        for (int i = 0; i < 3; ++i) {
          // The corners (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1) of a square.
          const bool u = upper ? corner == 1 : corner >= 1;
          const bool v = upper ? corner >= 1 : corner == 2;
          add(i == axis ? static_cast<float>(face % 2)
                        : static_cast<float>(i == (axis + 1) % 3 ? u : v));
        }
      add(std::uint16_t{0});
    }
  return bytes;
}

void
writeTexts(const fs::path& folder)
{
  for (const auto& [name, text] : sampleTexts()) {
    fs::create_directories((folder / name).parent_path());
    test::writeText(folder / name, text);
  }
  test::writeText(folder / "cube.stl", cubeStl());
}

/** The scans of folder_xyz in national coordinates, with the odometry that they had. */
void
makeFarScans(const fs::path& folder)
{
  fs::copy(folder / "folder_xyz", folder / "folder_far");
  for (int i = 0; i < 4; ++i) {
    const fs::path file =
        folder / "folder_far" / ("scan00" + std::to_string(i) + ".xyz");
    std::istringstream rows(test::readText(file));
    std::ostringstream far;
    far << std::fixed << std::setprecision(6);
    for (double x = 0, y = 0, z = 0; rows >> x >> y >> z;)
      far << x + 512345 << ' ' << y + 5403210 << ' ' << z + 317 << '\n';
    test::writeText(file, far.str());
  }
}

/** Four scans with odometry, and one of them in every format. */
void
makeScans(const Maker& run, const fs::path& folder)
{
  run("pcl_slam6d_simulate",
      "rooms -o drive --scans 40 --resolution 8 --labels no --odometry visual-inertial "
      "--quiet");
  fs::create_directory(folder / "scans");
  std::istringstream odometry(test::readText(folder / "drive/odometry.txt"));
  std::string poses, row;
  for (int i = 0; i < 4; ++i) {
    const std::string name = "scan00" + std::to_string(i) + ".pcd";
    fs::copy(folder / "drive" / name, folder / "scans" / name);
    std::getline(odometry, row);
    poses += row + '\n';
  }
  test::writeText(folder / "scans/odometry.txt", poses);
  test::writeText(folder / "path.kitti", poses);
  fs::remove_all(folder / "drive");
  run("pcl_slam6d_simulate", // denser: for a detector's training, and room for a person
      "rooms -o background --scans 3 --resolution 3 --labels no --quiet");
  const std::string convert = "scans scans/scan000.pcd -o scan";
  run("pcl_slam6d_convert", convert + "_ascii.pcd --encoding ascii");
  run("pcl_slam6d_convert", convert + "_binary.pcd --encoding binary");
  run("pcl_slam6d_convert", convert + "_packed.pcd --encoding binary_compressed");
  run("pcl_slam6d_convert", convert + "_ascii.ply --encoding ascii");
  run("pcl_slam6d_convert", convert + "_binary.ply --encoding binary");
  run("pcl_slam6d_convert", convert + ".3d");
  run("pcl_slam6d_convert", convert + ".bin");
  run("pcl_slam6d_convert", convert + ".xyz");
  run("pcl_slam6d_convert", convert + ".las");
  run("pcl_slam6d_convert", convert + ".laz");
  for (const char* const format : {"uos", "uosr", "kitti", "xyz", "ply", "pcd"})
    run("pcl_slam6d_convert",
        std::string("scans scans -o folder_") + format + " --format " + format);
  run("pcl_slam6d_convert", "scans scans -o site.e57");
  makeFarScans(folder);
}

void
makePaths(const Maker& run)
{
  for (const char* const format : {"tum", "g2o"})
    run("pcl_slam6d_convert",
        std::string("trajectory path.kitti -o path.") + format + " --format " + format);
  for (const char* const format : {"pose", "frames"})
    run("pcl_slam6d_convert",
        std::string("trajectory path.kitti -o path_") + format + " --format " + format);
}

/** Takes the sizes and sums of the files off a run's summary: who breaks a file shall meet
 * its reader, not the check that stands before it. */
void
forgetSums(const fs::path& file)
{
  auto summary = nlohmann::ordered_json::parse(test::readText(file));
  summary.erase("files");
  test::writeText(file, summary.dump(1) + '\n');
}

/** A finished run of all scans but one, with planes, objects and a semantic map. */
void
makeRun(const Maker& run, const fs::path& folder)
{
  run("pcl_slam6d", "scans -o run --last 2 --planes --no-picture --quiet");
  run("pcl_slam6d_semantic_map", "build run --objects objects.json --quiet");
  fs::copy(folder / "objects.json", folder / "run/objects.json");
  forgetSums(folder / "run/summary.json");
  fs::remove(folder / "run/planes.png");
  run("pcl_slam6d", "site.e57 -o run_of_site --last 2 --no-picture --quiet");
  fs::remove(folder / "run/hulls.ply");
  fs::copy(folder / "run/graph.g2o", folder / "graph.g2o");
  run("pcl_slam6d_graph", "convert graph.g2o -o graph.toro");
  fs::copy(folder / "run/semantic_map.json", folder / "semantic_map.json");
  fs::copy(folder / "run/planes.json", folder / "planes.json");
}
} // namespace

void
makeSamples(const fs::path& programs, const fs::path& share, const fs::path& folder)
{
  fs::create_directories(folder);
  writeTexts(folder);
  writePictures(folder);
  const Maker run(programs, folder);
  makeScans(run, folder);
  makePaths(run);
  makeRun(run, folder);
  fs::copy(share / "models/box", folder / "model", fs::copy_options::recursive);
  fs::copy(share / "rules/book.json", folder / "rules.json");
  fs::remove(folder / "out.log");
  fs::remove(folder / "err.log");
}

} // namespace pcl6d::faults
