// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/first_steps.h"

#include <algorithm>
#include <array>

namespace pcl6d::app {

namespace {
struct Command {
  const char* words; ///< behind the name of the program
  const char* result;
};

struct FirstSteps {
  const char* program;
  const char* purpose;
  std::array<Command, 3> commands;
};

constexpr FirstSteps kFirstSteps[] = {
    {"pcl_slam6d",
     "registers 3D scans into one map, and reports how reliable the map is",
     {{{"SCAN_DIR -o OUT_DIR --report",
        "a folder of scans: map, poses, page for a browser"},
       {"DRIVE.bag -o OUT_DIR", "the recording of a robot"},
       {"SCAN_DIR -o OUT_DIR --explain", "print the plan of the run, and stop"}}}},
    {"pcl_slam6d_convert",
     "converts scans, poses and maps between file formats",
     {{{"info FILE", "fields, poses and topics of a file or folder"},
       {"scans SCAN_DIR -o DIR --format pcd", "scans in another format"},
       {"map RUN -o map.yaml", "a finished run as a grid map of ROS"}}}},
    {"pcl_slam6d_doctor",
     "compares PCL's registration classes with ours on two clouds",
     {{{"SOURCE TARGET", "a report in the terminal"},
       {"SOURCE TARGET -o report.html", "a page for a browser"},
       {"SOURCE TARGET --guess \"X Y Z R P Y\"", "with an initial pose"}}}},
    {"pcl_slam6d_evaluate",
     "measures errors of trajectories, maps and relative poses",
     {{{"trajectory RUN/trajectory.tum REFERENCE", "errors against a reference"},
       {"map RUN", "quality of a map without a reference"},
       {"verify SCAN_A SCAN_B", "whether the relative pose of two scans is right"}}}},
    {"pcl_slam6d_graph",
     "optimises and converts pose graphs (g2o, TORO)",
     {{{"info IN.g2o", "vertices, links and residuals"},
       {"optimize IN.g2o -o OUT.g2o", "the poses that fit the links best"},
       {"convert IN.g2o -o OUT.graph", "the graph as TORO"}}}},
    {"pcl_slam6d_localize",
     "finds the poses of further scans in the map of a finished run",
     {{{"RUN SCAN_DIR -o OUT_DIR", "a folder of scans, one after the other"},
       {"RUN SCAN.pcd -o OUT_DIR", "a single scan"},
       {"--help", "odometry and limits"}}}},
    {"pcl_slam6d_objects",
     "finds objects of known shape in scans",
     {{{"locate RUN --store share/models -o OUT_DIR",
        "all objects of a store of models"},
       {"locate SCAN.pcd --model chair.ply -o OUT_DIR", "one object from a mesh"},
       {"targets SCAN_DIR -o targets.csv --sphere-diameter 0.145",
        "spheres of a survey"}}}},
    {"pcl_slam6d_planes",
     "finds the planes of scans, and labels floor, ceiling, walls and doors",
     {{{"RUN -o OUT_DIR", "the planes of a finished run"},
       {"SCAN.pcd -o OUT_DIR", "the planes of one scan"},
       {"RUN -o OUT_DIR --no-labels", "the planes without labels"}}}},
    {"pcl_slam6d_render",
     "draws pictures, films and reports of a finished run",
     {{{"picture RUN -o DIR", "views of map, poses and links as PNG files"},
       {"animation RUN --kind growth -o film.mp4", "the map as it grows"},
       {"report RUN", "one page for a browser"}}}},
    {"pcl_slam6d_semantic_map",
     "builds and queries maps of planes, objects and rooms",
     {{{"build RUN --store share/models", "the semantic map of a finished run"},
       {"query RUN \"objects class=chair\"", "chairs, with poses and rooms"},
       {"info RUN", "number of planes, objects and rooms"}}}},
    {"pcl_slam6d_simulate",
     "simulates a robot that scans a scene, with known poses",
     {{{"corridor -o DIR", "scans, odometry and truth of an indoor loop"},
       {"MESH.ply -o DIR --path WAYPOINTS.txt", "a drive through a mesh of your own"},
       {"intrude RUN --people 4 -o DIR", "walkers in recorded scans"}}}},
};
} // namespace

std::string
firstSteps(const std::string& program)
{
  const auto* const steps = std::find_if(
      std::begin(kFirstSteps), std::end(kFirstSteps), [&](const FirstSteps& candidate) {
        return program == candidate.program;
      });
  if (steps == std::end(kFirstSteps))
    return "";
  std::size_t widest = 0;
  for (const Command& command : steps->commands)
    widest = std::max(widest, std::string(command.words).size());
  std::string text = program + " " + steps->purpose + ".\n";
  for (const Command& command : steps->commands) {
    std::string words = command.words;
    words.resize(widest, ' ');
    text.append("  ").append(program).append(" ").append(words);
    text.append("  ").append(command.result).append("\n");
  }
  return text + "All options: " + program + " --help\n";
}

} // namespace pcl6d::app
