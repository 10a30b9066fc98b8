// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d {

RayTest::RayTest(const Ray& ray) : origin_(ray.origin)
{
  ray.direction.cwiseAbs().maxCoeff(&kz_);
  kx_ = (kz_ + 1) % 3;
  ky_ = (kz_ + 2) % 3;
  shear_x_ = ray.direction[kx_] / ray.direction[kz_];
  shear_y_ = ray.direction[ky_] / ray.direction[kz_];
  scale_z_ = 1 / ray.direction[kz_];
}

double
RayTest::range(const Eigen::Vector3d& a,
               const Eigen::Vector3d& b,
               const Eigen::Vector3d& c) const
{
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  // Shear to make the ray the z axis; the triangle test becomes planar.
  const double az = a[kz_] - origin_[kz_];
  const double bz = b[kz_] - origin_[kz_];
  const double cz = c[kz_] - origin_[kz_];
  const double ax = a[kx_] - origin_[kx_] - shear_x_ * az;
  const double ay = a[ky_] - origin_[ky_] - shear_y_ * az;
  const double bx = b[kx_] - origin_[kx_] - shear_x_ * bz;
  const double by = b[ky_] - origin_[ky_] - shear_y_ * bz;
  const double cx = c[kx_] - origin_[kx_] - shear_x_ * cz;
  const double cy = c[ky_] - origin_[ky_] - shear_y_ * cz;
  // Edge functions: twice the areas against the corners A, B and C.
  const double u = cx * by - cy * bx;
  const double v = ax * cy - ay * cx;
  const double w = bx * ay - by * ax;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
    return kMiss;
  const double determinant = u + v + w;
  if (determinant == 0)
    return kMiss;
  const double range = scale_z_ * ((u * az + v * bz + w * cz) / determinant);
  return range > 0 ? range : kMiss;
}

namespace {
// Embree computes in float. Relative to the middle of a scene of radius R, rounding of
// a box, of a ray's origin (at most 5 R away) and of its direction (at most 7 R long)
// together stay below 40 R 2^-24; the padding of the boxes is larger.
constexpr double kPadding = 0x1.0p-17; // of the scene's radius

struct Boxes {
  const TriangleScene* scene;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;  // [m] around the centre
  double padding = 0; // [m]
};

struct Candidates {
  RTCIntersectContext context; // first: Embree's callbacks get its address
  const RayTest* test;
  double advance; // [m] by which Embree's ray starts later
  RayHit best;    // range: infinity before the first hit
};

void
triangleBounds(const RTCBoundsFunctionArguments* arguments)
{
  const auto& boxes = *static_cast<const Boxes*>(arguments->geometryUserPtr);
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 3; ++corner)
    box.extend(boxes.scene->corner(arguments->primID, corner) - boxes.centre);
  const Eigen::Vector3f low = (box.min().array() - boxes.padding).cast<float>();
  const Eigen::Vector3f high = (box.max().array() + boxes.padding).cast<float>();
  *arguments->bounds_o = {
      low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

void
testTriangle(const RTCIntersectFunctionNArguments* arguments)
{
  if (arguments->N != 1 || arguments->valid[0] == 0)
    return;
  const auto& boxes = *static_cast<const Boxes*>(arguments->geometryUserPtr);
  auto& candidates = *reinterpret_cast<Candidates*>(arguments->context);
  const std::uint32_t index = arguments->primID;
  const double range = candidates.test->range(boxes.scene->corner(index, 0),
                                              boxes.scene->corner(index, 1),
                                              boxes.scene->corner(index, 2));
  RayHit& best = candidates.best;
  const bool is_better =
      range < best.range ||
      (range == best.range && std::isfinite(range) && index < best.triangle);
  if (!is_better)
    return;
  best.range = range;
  best.triangle = index;
  // Later boxes can be skipped, boxes at equal range cannot.
  reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar =
      static_cast<float>(range - candidates.advance + boxes.padding);
}
} // namespace

struct RayCaster::Impl {
  explicit Impl(TriangleScene triangles) : scene(std::move(triangles))
  {
    scene.validate();
    if (scene.triangles.empty())
      throw BadArgument("the scene has 0 triangles, but must have at least 1");
    Eigen::AlignedBox3d box;
    for (const auto& triangle : scene.triangles)
      for (const auto vertex : triangle.vertices)
        box.extend(scene.vertices[vertex]);
    boxes = {&scene, box.center(), box.diagonal().norm() / 2, 0};
    boxes.padding = kPadding * boxes.radius;
    // With more threads, a thread refused by the system ends the process: TBB's
    // exception passes Embree, whose destructors then throw. Trees of 300 000 triangles
    // take half a second.
    device = rtcNewDevice("threads=1");
    if (!device)
      throw ComputeFailed("Embree cannot start (error " +
                          std::to_string(rtcGetDeviceError(nullptr)) + ")");
    buildTree();
  }

  ~Impl()
  {
    rtcReleaseScene(tree);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl&
  operator=(const Impl&) = delete;

  void
  buildTree()
  {
    tree = rtcNewScene(device);
    rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry,
                                     static_cast<unsigned int>(scene.triangles.size()));
    rtcSetGeometryUserData(geometry, &boxes);
    rtcSetGeometryBoundsFunction(geometry, triangleBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, testTriangle);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree, geometry);
    rtcReleaseGeometry(geometry);
    rtcJoinCommitScene(tree); // in this thread; rtcCommitScene() needs another thread
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE)
      return;
    rtcReleaseScene(tree);
    rtcReleaseDevice(device);
    throw ComputeFailed("Embree cannot build a tree over " +
                        std::to_string(scene.triangles.size()) + " triangles (error " +
                        std::to_string(error) + ")");
  }

  TriangleScene scene;
  Boxes boxes;
  RTCDevice device = nullptr;
  RTCScene tree = nullptr;
};

RayCaster::RayCaster(TriangleScene scene) : impl_(new Impl(std::move(scene)))
{}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster&
RayCaster::operator=(RayCaster&&) noexcept = default;

const TriangleScene&
RayCaster::scene() const
{
  return impl_->scene;
}

std::optional<RayHit>
RayCaster::cast(const Ray& ray, double max_range) const
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!isPlace(ray.origin) || !ray.direction.allFinite())
    return {}; // Embree may end the process for invalid rays
  const Boxes& boxes = impl_->boxes;
  const RayTest test(ray);
  // From afar Embree starts nearer, where float is fine enough; our own test does not.
  const Eigen::Vector3d outside = ray.origin - boxes.centre;
  const double advance = std::max(0.0, outside.norm() - 4 * boxes.radius);
  const Eigen::Vector3f origin = (outside + advance * ray.direction).cast<float>();
  const Eigen::Vector3f direction = ray.direction.cast<float>();

  Candidates candidates{{}, &test, advance, {kInfinity, 0, 1, false}};
  rtcInitIntersectContext(&candidates.context);
  RTCRayHit query{};
  query.ray = {origin.x(),
               origin.y(),
               origin.z(),
               0,
               direction.x(),
               direction.y(),
               direction.z(),
               0,
               std::numeric_limits<float>::infinity(),
               ~0u,
               0,
               0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->tree, &candidates.context, &query);

  RayHit hit = candidates.best;
  if (!(hit.range <= max_range) || hit.range == kInfinity)
    return std::nullopt;
  const double cosine = impl_->scene.normal(hit.triangle).dot(ray.direction);
  hit.cos_incidence = std::min(1.0, std::abs(cosine));
  hit.is_from_behind = cosine > 0;
  return hit;
}

} // namespace pcl6d
