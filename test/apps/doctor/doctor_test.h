// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace pcl6d::test {

inline constexpr const char* kDoctorName = "pcl_slam6d_doctor";

/** \return a PCD file of points in text, in float64 or float32 */
inline std::string
pcdOf(const std::vector<Eigen::Vector3d>& points, bool in_double = false)
{
  std::ostringstream text;
  const char* const size = in_double ? " 8 8 8" : " 4 4 4";
  text << "VERSION 0.7\nFIELDS x y z\nSIZE" << size
       << "\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << points.size()
       << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << points.size()
       << "\nDATA ascii\n";
  text.precision(in_double ? 17 : 9);
  for (const auto& p : points) {
    if (p.allFinite())
      text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    else
      text << "nan nan nan\n";
  }
  return text.str();
}

/** \brief A folder with two scans of a room, taken at two places that are known. */
struct DoctorRoom : TempFolder {
  /** \param[in] offset [m] added to the points of both, in double */
  explicit DoctorRoom(const Eigen::Vector3d& offset = Eigen::Vector3d::Zero())
  {
    Random random(3);
    const PillarRoom room;
    const Eigen::Isometry3d first = planarPose(-1, 0.3, 0.1);
    for (const auto& p : room.scan(first, random, 0.05))
      target.push_back(p.cast<double>() + offset);
    for (const auto& p : room.scan(first * truth, random, 0.05))
      source.push_back(p.cast<double>() + offset);
  }

  /** Writes both. \return their files */
  std::vector<std::string>
  write(bool in_double = false) const
  {
    writeText(*this / "source.pcd", pcdOf(source, in_double));
    writeText(*this / "target.pcd", pcdOf(target, in_double));
    return {*this / "source.pcd", *this / "target.pcd"};
  }

  std::vector<Eigen::Vector3d> source, target;
  Eigen::Isometry3d truth = poseFromEuler({0.15, -0.1, 0.02}, {0.01, -0.01, 0.05});
};

/** \brief What the doctor did, and its JSON. */
struct Consultation : Outcome {
  nlohmann::json json;

  /** \return the measured text of the finding of these words; empty: there is none */
  std::string
  measured(const std::string& what) const
  {
    for (const auto& finding : json["findings"])
      if (finding["what"].get<std::string>().find(what) != std::string::npos)
        return finding["measured"];
    return {};
  }

  /** \return the run of a class whose settings begin so */
  nlohmann::json
  run(const std::string& name, const std::string& settings) const
  {
    for (const auto& one : json["runs"])
      if (one["class"] == name &&
          one["settings"].get<std::string>().rfind(settings, 0) == 0)
        return one;
    ADD_FAILURE() << "no run of " << name << ", " << settings;
    return {};
  }
};

inline Consultation
consult(std::vector<std::string> arguments)
{
  const TempFolder folder;
  const std::string file = folder / "doctor.json";
  arguments.insert(arguments.end(), {"--quiet", "--json", file});
  Consultation consultation;
  static_cast<Outcome&>(consultation) = runProgram(kDoctorName, arguments);
  const std::string text = readText(file);
  if (!text.empty())
    consultation.json = nlohmann::json::parse(text);
  return consultation;
}

} // namespace pcl6d::test
