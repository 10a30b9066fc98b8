// SPDX-License-Identifier: BSD-3-Clause
// What cannot be evaluated, and what must not be asked.
#include "moving_room.h"
#include "support/points.h"
#include "visibility/rays.h"

#include <deque>

namespace pcl6d {
namespace {

using namespace test;

Points
sphereOf(double radius, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero())
{
  return scanAround(20000, origin, [&](auto&&) { return radius; });
}

/** Rays of spheres, without surfaces. */
class RaysAlone : public testing::Test {
protected:
  SeenScan
  sphere(double radius)
  {
    images_.emplace_back(sphereOf(radius));
    SeenScan scan;
    scan.rays = &images_.back();
    return scan;
  }
  std::deque<RayImage> images_;
};

std::size_t
count(const std::vector<PointMotion>& motion, PointMotion kind)
{
  return static_cast<std::size_t>(std::count(motion.begin(), motion.end(), kind));
}

TEST_F(RaysAlone, OneScanKnowsNothing)
{
  const Points points = sphereOf(3);
  const auto alone = MovingPoints({sphere(3)}).classify(0, points);
  EXPECT_EQ(alone, std::vector<PointMotion>(points.size(), PointMotion::kUnknown));
  const auto with_mute = MovingPoints({sphere(3), SeenScan()}).classify(0, points);
  EXPECT_EQ(with_mute, alone) << "a scan without rays observers nobody";
  EXPECT_EQ(MovingPoints(std::vector<SeenScan>{}).size(), 0u);
}

TEST_F(RaysAlone, JudgeWithoutSurfaces)
{
  // A ball of directions that the other scan sees through, in a sphere that both see.
  const auto rangeOf = [](const Eigen::Vector3d& way) {
    return way.x() > 0.95 ? 2.0 : 4.0;
  };
  const Points points = scanAround(20000, {0, 0, 0}, rangeOf);
  images_.emplace_back(points);
  SeenScan evaluated;
  evaluated.rays = &images_.back();
  const MovingPoints observers({evaluated, sphere(4)});
  EXPECT_EQ(observers.background(), 0) << "is told by surfaces";
  const auto motion = observers.classify(0, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(motion[i],
              points[i].norm() < 3 ? PointMotion::kDynamic : PointMotion::kStatic)
        << points[i].transpose();
}

TEST_F(RaysAlone, FewMissesMayBeChance)
{
  // The points of a cap of the sphere are nearer than the other scan saw: one or two of them
  // may be dust, thirty are a thing.
  const auto told = [&](double cap) {
    const Points points = scanAround(20000, {0, 0, 0}, [&](const Eigen::Vector3d& way) {
      return way.x() > 1 - cap ? 2.0 : 4.0;
    });
    images_.emplace_back(points);
    SeenScan evaluated;
    evaluated.rays = &images_.back();
    return count(MovingPoints({evaluated, sphere(4)}).classify(0, points),
                 PointMotion::kDynamic);
  };
  EXPECT_EQ(told(2e-4), 0u);
  EXPECT_GT(told(3e-3), 25u);
}

TEST_F(RaysAlone, ALineOfCellsMayBeAnEdge)
{
  // A band before what the other scan saw: one line of cells is how the edge of a table looks
  // whose place is a little wrong, many lines are a thing.
  const auto told = [&](double half_width) {
    const Points points = scanAround(20000, {0, 0, 0}, [&](const Eigen::Vector3d& way) {
      return way.x() > 0.9 && std::abs(way.z()) < half_width ? 2.0 : 4.0;
    });
    images_.emplace_back(points);
    SeenScan evaluated;
    evaluated.rays = &images_.back();
    return count(MovingPoints({evaluated, sphere(4)}).classify(0, points),
                 PointMotion::kDynamic);
  };
  EXPECT_EQ(told(0.004), 0u);
  EXPECT_GT(told(0.1), 100u);
}

/** \brief A plate 1 m ahead of and 0.6 m below a scanner, and scans of a sphere without the plate,
 * from 0.06 m above its plane and 7 m away, where their rays are 0.17 m apart. */
struct PlateTest {
  double half_width = 0.3; ///< [m] of a height of 0.6 m
  bool is_upright = true;  ///< else lying, and 5 mm high for the scans that miss it
  bool is_hit = false;     ///< by another scan
  int misses = 2;          ///< scans without the plate

  std::size_t
  dynamic(std::deque<RayImage>& images) const
  {
    const Eigen::Vector3d plate(0.8, 0, -0.6);
    const Eigen::Vector3d normal =
        is_upright ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    const Points points = scanAround(20000, {0, 0, 0}, [&](const Eigen::Vector3d& way) {
      const double range = plate.dot(normal) / way.dot(normal);
      const Eigen::Vector3d off = range * way - plate;
      return range > 0 && off.cwiseAbs().maxCoeff() < 0.3 &&
                     std::abs(off.y()) < half_width
                 ? range
                 : 20.0;
    });
    images.emplace_back(points);
    SeenScan evaluated;
    evaluated.rays = &images.back();
    std::vector<SeenScan> scans(is_hit ? 2 : 1, evaluated);
    for (int k = 0; k < misses; ++k) {
      SeenScan& other = scans.emplace_back();
      other.T_world_scan.translation() = Eigen::Vector3d(-6, 0.1 * k, -0.54);
      images.emplace_back(scanAround(
          20000, {0, 0, 0}, [&](const Eigen::Vector3d& way) { // to the sphere
            const Eigen::Vector3d from = other.T_world_scan.translation();
            const double b = from.dot(way);
            return std::sqrt(b * b + 20 * 20 - from.squaredNorm()) - b;
          }));
      other.rays = &images.back();
    }
    return count(MovingPoints(scans).classify(0, points), PointMotion::kDynamic);
  }
};

TEST_F(RaysAlone, APlateSeenAtAFlatAngleMayBePassedBeside)
{
  PlateTest plate; // upright it would fill 12 rays
  EXPECT_GT(plate.dynamic(images_), 100U);
  plate.is_upright = false;
  EXPECT_EQ(plate.dynamic(images_), 0U) << "the edge of a platform";
  plate.is_hit = true;
  EXPECT_EQ(plate.dynamic(images_), 0U) << "the top of a table";
}

TEST_F(RaysAlone, ManyScansDoNotPassBesideANarrowThingByChance)
{
  // Half as wide as the gaps between rays: a scan passes beside with probability 0.5, eight scans
  // with 0.004.
  PlateTest post;
  post.half_width = 0.04;
  post.misses = 1;
  EXPECT_EQ(post.dynamic(images_), 0U);
  post.misses = 8;
  EXPECT_GT(post.dynamic(images_), 20U);
}

TEST_F(RaysAlone, PointsThatAreNoneAreUnknown)
{
  const MovingPoints observers({sphere(3), sphere(3)});
  const auto motion =
      observers.classify(0, {{kNan, 0, 0}, {3, 0, 0}, {0, 0, 0}, {0, kInfinity, 0}});
  EXPECT_EQ(motion,
            (std::vector<PointMotion>{PointMotion::kUnknown,
                                      PointMotion::kStatic,
                                      PointMotion::kUnknown,
                                      PointMotion::kUnknown}));
  EXPECT_TRUE(observers.classify(0, {}).empty());
}

TEST_F(RaysAlone, ScansThatSeeNothingOfEachOtherKnowNothing)
{
  SeenScan far = sphere(3);
  far.T_world_scan.translation().x() = 1000;
  const Points points = sphereOf(3);
  EXPECT_EQ(
      count(MovingPoints({sphere(3), far}).classify(0, points), PointMotion::kUnknown),
      points.size());
}

TEST_F(RaysAlone, ScansOfTooFewPointsForAnImageJudgeNobody)
{
  images_.emplace_back(Points{{3, 0, 0}});
  SeenScan tiny;
  tiny.rays = &images_.back();
  const MovingPoints observers({sphere(3), tiny});
  EXPECT_EQ(observers.classify(0, {{2, 0, 0}}),
            std::vector<PointMotion>{PointMotion::kUnknown});
  EXPECT_EQ(observers.classify(1, {{3, 0, 0}}),
            std::vector<PointMotion>{PointMotion::kStatic})
      << "but is judged";
}

TEST_F(RaysAlone, RefusesWhatBreaksARule)
{
  const auto refused = [&](const std::function<void(SeenScan&)>& spoil) {
    std::vector<SeenScan> scans{sphere(3), sphere(3)};
    spoil(scans[1]);
    return badArgumentOf([&] { (void)MovingPoints(scans); });
  };
  const auto starts = [](const std::string& text, const std::string& with) {
    return text.compare(0, with.size(), with) == 0;
  };
  const Points wall{{3, 0, 0}, {3, 1, 0}};
  const Normals normals{{-1, 0, 0}, {-1, 0, 0}}, too_few{{-1, 0, 0}};
  const PointTree tree(wall);
  const auto dress = [&](SeenScan& s) {
    s.surface = &wall;
    s.normals = &normals;
    s.tree = &tree;
    s.voxel = 0.1;
  };
  EXPECT_EQ(refused(dress), "");
  EXPECT_TRUE(starts(refused([](SeenScan& s) { s.T_world_scan.linear() *= 2; }),
                     "scan 1: T_world_scan = "));
  for (const double bad : {-1.0, double{kNan}, double{kInfinity}}) {
    EXPECT_TRUE(starts(refused([&](SeenScan& s) { s.sigma.translation = bad; }),
                       "scan 1: sigma of translation = "));
    EXPECT_TRUE(starts(refused([&](SeenScan& s) { s.sigma.rotation = bad; }),
                       "scan 1: sigma of rotation = "));
    EXPECT_TRUE(starts(refused([&](SeenScan& s) {
                         dress(s);
                         s.voxel = bad;
                       }),
                       "scan 1: voxel = "));
  }
  for (const auto& lack : std::vector<std::function<void(SeenScan&)>>{
           [](SeenScan& s) { s.tree = nullptr; },
           [](SeenScan& s) { s.normals = nullptr; },
           [&](SeenScan& s) { s.normals = &too_few; }})
    EXPECT_TRUE(starts(refused([&](SeenScan& s) {
                         dress(s);
                         lack(s);
                       }),
                       "scan 1: normals of the surface = "));
}

TEST_F(RaysAlone, RefusesScansThatAreNotThere)
{
  const MovingPoints observers({sphere(3), SeenScan()});
  EXPECT_EQ(badArgumentOf([&] { (void)observers.classify(2, {}); }),
            "scan = 2, but must be one of 2");
  EXPECT_EQ(badArgumentOf([&] { (void)observers.classify(1, {}); }),
            "rays of the scan = none, but must be there");
}

TEST(MovingPointsOptions, RefuseWhatBreaksARule)
{
  for (const std::size_t bad : {std::size_t{0}, std::size_t{9}}) {
    MovingPointsOptions options;
    options.neighbours = bad;
    EXPECT_NE(badArgumentOf([&] { options.validate(); }).find("neighbours = "),
              std::string::npos);
    EXPECT_NE(badArgumentOf([&] { (void)MovingPoints({}, options); }), "");
    EXPECT_NE(badArgumentOf([&] { (void)MovingScans(options); }), "");
  }
  MovingPointsOptions options;
  for (options.neighbours = 1; options.neighbours <= 8; ++options.neighbours)
    EXPECT_NO_THROW(options.validate());
}

TEST(BlindScans, WhereAllContradictsNothingIsTold)
{
  // Each scan is of a larger room, so that all points of one are seen through by the next.
  std::vector<TrueScan> scans;
  Random random(2);
  for (int i = 0; i < 4; ++i) {
    MovingRoom room;
    const Eigen::Vector3d more(i, i, 0.5 * i);
    room.walls = {room.walls.min() - more, room.walls.max() + more};
    room.step = 0.025;
    scans.push_back(room.scan(tripod(0, 0, 0.3 * i), random));
  }
  MovingScans observers;
  for (const TrueScan& scan : scans)
    observers.add(scan.points, scan.T_world_scan);
  EXPECT_TRUE(observers.isBlind());
  EXPECT_GT(observers.observers().background(), 0.5);
  EXPECT_EQ(count(observers.motion(0, scans[0].points), PointMotion::kUnknown),
            scans[0].points.size());
}

TEST(BlindScans, WrongPosesMakeBlindAndRightOnesDoNot)
{
  MovingRoom room;
  room.step = 0.025;
  const auto nobody = [](std::size_t) {
    return std::vector<Body>{standing(3, 2, {0.8, 1.2, 2}, Met::kRoom)};
  };
  const auto scans = scansOf(room, 6, nobody);
  MovingScans right, wrong;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    right.add(scans[i].points, scans[i].T_world_scan);
    const double way = 0.5 * static_cast<double>(i); // [m]
    wrong.add(scans[i].points,
              Eigen::Translation3d(way, -way, 0) * scans[i].T_world_scan);
  }
  EXPECT_FALSE(right.isBlind());
  EXPECT_TRUE(wrong.isBlind());
}

} // namespace
} // namespace pcl6d
