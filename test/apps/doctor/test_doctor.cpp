// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_doctor as a user runs it.
#include "apps/doctor/doctor_test.h"
#include "support/points.h"

#include <cmath>
#include <limits>

namespace {
using pcl6d::test::consult;
using pcl6d::test::Consultation;
using pcl6d::test::DoctorRoom;
using pcl6d::test::kNan;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
using Json = nlohmann::json;

Eigen::Isometry3d
poseOf(const Json& run)
{
  Eigen::Isometry3d pose;
  for (int i = 0; i < 16; ++i)
    pose.matrix()(i / 4, i % 4) = run["pose"][static_cast<std::size_t>(i)];
  return pose;
}

/** \return [m] how far a run puts the scanner of the source off its place */
double
errorOf(const Json& run, const DoctorRoom& room, const Eigen::Vector3d& offset)
{
  return (poseOf(run) * offset - (room.truth.translation() + offset)).norm();
}

// Ranges have 5 mm of noise, surfaces thousands of points; a scan is right within a
// fifth of the 0.25 m between its rays on the walls.
constexpr double kRight = 0.05; // [m]
} // namespace

TEST(Doctor, VerifiesOursAndWritesTheSameAsTextHtmlAndJson)
{
  const DoctorRoom room;
  auto arguments = room.write();
  arguments.insert(arguments.end(), {"-o", room / "report.html"});
  const Consultation said = consult(arguments);
  ASSERT_EQ(said.exit_code, 0) << said.err << said.out;
  EXPECT_EQ(said.json["schema_version"], 2);
  EXPECT_TRUE(said.json["verified"].get<bool>());
  const Json best = said.json["runs"][said.json["best_of_ours"].get<std::size_t>()];
  EXPECT_EQ(best["verdict"]["result"], "good");
  EXPECT_LT(errorOf(best, room, Eigen::Vector3d::Zero()), kRight);
  const std::string html = readText(room / "report.html");
  for (const auto& run : said.json["runs"])
    for (const char* const key : {"class", "settings"}) {
      EXPECT_NE(said.out.find(run[key].get<std::string>()), std::string::npos);
      EXPECT_NE(html.find(run[key].get<std::string>()), std::string::npos);
    }
  const std::string conclusion = said.json["conclusion"];
  EXPECT_NE(said.out.find("\n" + conclusion + "\n"), std::string::npos);
  EXPECT_NE(html.find(">" + conclusion + "<"), std::string::npos);
  EXPECT_NE(html.find("<svg"), std::string::npos);
  for (const char* const of_others : {"http", "src=", "<script"})
    EXPECT_EQ(html.find(of_others), std::string::npos) << of_others;
}

TEST(Doctor, RunsEachClassOnItsOwn)
{
  const DoctorRoom room;
  const Consultation said = consult(room.write());
  for (const char* const name : {"pcl::IterativeClosestPoint",
                                 "pcl::IterativeClosestPointWithNormals",
                                 "pcl::GeneralizedIterativeClosestPoint",
                                 "pcl::NormalDistributionsTransform"}) {
    EXPECT_EQ(said.run(name, "as it is")["end"], "done");
    EXPECT_EQ(said.run(name, std::string(name).back() == 'm' ? "resol" : "max")["end"],
              "done");
  }
  for (const char* const name :
       {"pcl6d::ICP6D", "pcl6d::ICP6DWithNormals", "pcl6d::GICP6D"})
    EXPECT_EQ(said.run(name, "max distance")["end"], "done");
  EXPECT_EQ(said.run("pcl6d::NDT6D", "resolution")["end"], "done");
}

TEST(Doctor, SeesTheIterationLimitCountedAsConvergence)
{
  const DoctorRoom room;
  const Consultation said = consult(room.write());
  const Json icp = said.run("pcl::IterativeClosestPoint", "as it is");
  ASSERT_TRUE(icp["converged"]);
  ASSERT_EQ(icp["iterations"], 10);
  EXPECT_EQ(icp["state"], "iteration limit");
  EXPECT_GT(icp["longer"]["iterations"], 10);
  const std::string measured = said.measured("limit is counted as convergence");
  EXPECT_NE(measured.find("after 10 of 10 iterations"), std::string::npos) << measured;
}

TEST(Doctor, MeasuresWhatIsLostFarFromZero)
{
  const Eigen::Vector3d utm(450000, 5950000, 120);
  const DoctorRoom room(utm);
  const Consultation said = consult(room.write(/*in_double=*/true));
  EXPECT_NE(said.measured("is not read by PCL").find("float64"), std::string::npos);
  EXPECT_NE(said.measured("few digits left").find("float steps are 0.5 m"),
            std::string::npos);
  EXPECT_FALSE(said.measured("digits are lost far from 0").empty()) << said.out;
  // The scanner's ground is beside 0: the whole metres in the middle are taken off.
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = said.json["target"]["offset"][static_cast<std::size_t>(axis)];
    EXPECT_EQ(offset, std::round(offset));
    EXPECT_NEAR(offset, utm[axis], 10);
  }
  const Json ours = said.run("pcl6d::ICP6DWithNormals", "max distance");
  Json near;
  for (const auto& run : said.json["runs"])
    if (run["class"] == "pcl6d::ICP6DWithNormals" &&
        run["settings"].get<std::string>().find("near 0") != std::string::npos)
      near = run;
  ASSERT_FALSE(near.is_null()) << said.out;
  EXPECT_LT(errorOf(near, room, utm), kRight);
  EXPECT_GT(errorOf(ours, room, utm), errorOf(near, room, utm));
  const Json icp = said.run("pcl::IterativeClosestPoint", "max distance");
  EXPECT_GT(errorOf(icp, room, utm), kRight); // and PCL calls it converged
  EXPECT_TRUE(icp["converged"]);
  EXPECT_FALSE(said.json["source"]["scanner_known"]);
}

TEST(Doctor, JudgesUtmScansByTheirRaysOnceItKnowsTheScanner)
{
  const DoctorRoom room(Eigen::Vector3d(450000, 5950000, 120));
  auto arguments = room.write(/*in_double=*/true);
  arguments.insert(arguments.end(),
                   {"--source-origin",
                    "450000 5950000 120",
                    "--target-origin",
                    "450000 5950000 120"});
  const Consultation said = consult(arguments);
  EXPECT_EQ(said.exit_code, 0) << said.out;
  EXPECT_TRUE(said.json["verified"]);
}

TEST(Doctor, SaysWhichClassesNanAndIndicesChange)
{
  DoctorRoom room;
  std::string numbers;
  for (std::size_t i = 0; i < room.source.size(); ++i) {
    if (i % 2 == 0)
      numbers += std::to_string(i) + (i % 3 == 0 ? "\n" : " ");
    else // what the indices leave out is elsewhere
      room.source[i].z() += 1.5;
    if (i % 10 == 0)
      room.source[i].setConstant(kNan);
  }
  room.target[5].setConstant(kNan);
  auto arguments = room.write();
  writeText(room / "numbers", numbers);
  arguments.insert(arguments.end(), {"--indices", room / "numbers"});
  const Consultation said = consult(arguments);
  EXPECT_NE(said.measured("SOURCE holds rows without finite").find("10 %"),
            std::string::npos);
  const Json icp = said.run("pcl::IterativeClosestPoint", "max distance");
  EXPECT_TRUE(icp.contains("without_nan"));
  EXPECT_EQ(icp["without_nan"]["end"], "done");
  const bool is_hurt = icp["end"] != "done"; // asserts may be off in another PCL
  const std::string by_nan = said.measured("rows of NaN change the result");
  EXPECT_EQ(by_nan.find("pcl::IterativeClosestPoint,") != std::string::npos, is_hurt);
  EXPECT_EQ(by_nan.find("pcl6d::"), std::string::npos) << by_nan;
  const std::string by_indices = said.measured("setIndices() is not honoured");
  EXPECT_NE(by_indices.find("pcl::GeneralizedIterativeClosestPoint"), std::string::npos)
      << said.out;
  EXPECT_NE(
      by_indices.find("pcl::IterativeClosestPoint, as it is: converged (iteration "
                      "limit), as without indices"),
      std::string::npos)
      << by_indices;
  EXPECT_EQ(by_indices.find("pcl6d::"), std::string::npos) << by_indices;
  EXPECT_LT(errorOf(said.run("pcl6d::ICP6DWithNormals", "max distance"),
                    room,
                    Eigen::Vector3d::Zero()),
            kRight);
}

TEST(Doctor, TakesAGuessAndTellsWhenItIsTheWrongWayRound)
{
  DoctorRoom room;
  const Eigen::Isometry3d away = pcl6d::poseFromEuler({20, -8, 0.5}, {0, 0, 0.4});
  for (auto& p : room.source)
    p = away * p;
  auto arguments = room.write();
  const auto written = [&](const Eigen::Isometry3d& guess) {
    std::ostringstream rows;
    rows.precision(17);
    rows << guess.matrix();
    writeText(room / "guess", rows.str());
    return std::string(room / "guess");
  };
  arguments.insert(arguments.end(),
                   {"--guess", written(away), "--source-origin", "20 -8 0.5"});
  EXPECT_FALSE(consult(arguments).measured("wrong way round").empty());
  written(away.inverse());
  const Consultation right = consult(arguments);
  EXPECT_TRUE(right.measured("wrong way round").empty());
  EXPECT_EQ(right.exit_code, 0) << right.out;
}

TEST(Doctor, SaysThatCopiesTellNothing)
{
  const DoctorRoom room;
  auto arguments = room.write();
  arguments[1] = arguments[0];
  const Consultation said = consult(arguments);
  EXPECT_EQ(said.exit_code, 3) << said.out;
  EXPECT_FALSE(said.measured("identical points").empty());
  EXPECT_LT(poseOf(said.run("pcl6d::ICP6D", "max")).translation().norm(), 1e-6);
}

TEST(Doctor, SeesDifferentUnits)
{
  DoctorRoom room;
  for (auto& p : room.source)
    p *= 1000;
  const Consultation said = consult(room.write());
  EXPECT_EQ(said.exit_code, 3);
  EXPECT_NE(said.measured("different units").find("millimetres and metres"),
            std::string::npos)
      << said.out;
}
