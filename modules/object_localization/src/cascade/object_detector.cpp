// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/object_detector.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

/** A window that passed every stage. */
struct ObjectDetector::Hit {
  ImageRect box;
  double range = 0; // [m]
};

namespace {
constexpr double kSameObject = 0.5; // overlap of two boxes, over their union

double
overlap(const ImageRect& a, const ImageRect& b)
{
  const int width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const int height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (width <= 0 || height <= 0)
    return 0;
  const double both = double{1} * width * height;
  return both /
         (double{1} * a.width * a.height + double{1} * b.width * b.height - both);
}

std::vector<std::size_t>
pointsBehind(const RangeImage& image,
             const DetectedObject& object,
             const Points& points,
             double depth)
{
  const ImageRect& b = object.box;
  std::vector<std::size_t> behind;
  for (const std::size_t i :
       image.pointsIn({{b.y, b.x}, {b.y + b.height - 1, b.x + b.width - 1}}))
    if (std::abs(double{points[i].norm()} - object.range) <= depth)
      behind.push_back(i);
  return behind;
}

bool
isSurer(const DetectedObject& a, const DetectedObject& b)
{
  return a.score > b.score;
}

void
checkCascades(const std::vector<HaarCascade>& cascades)
{
  for (const auto& cascade : cascades) {
    cascade.validate();
    if (!cascade.subject)
      throw BadArgument("the cascade lacks the channel and the size of the object: not "
                        "trained by pcl_slam6d_objects train");
  }
  if (cascades.size() == 1)
    return;
  const CascadeSubject &a = *cascades[0].subject, &b = *cascades[1].subject;
  if (a.channel == b.channel)
    throw BadArgument("both cascades look at one channel");
  if (a.pixel != b.pixel || a.slice_depth != b.slice_depth)
    throw BadArgument("the cascades look at pictures of another pixel or slice depth");
}

DetectionViewOptions
viewsOf(const HaarCascade& cascade, DetectionViewOptions views)
{
  if (cascade.subject) {
    views.pixel = cascade.subject->pixel;
    views.slice_depth = cascade.subject->slice_depth;
  }
  return views;
}
} // namespace

DetectionRule
detectionRuleFromName(const std::string& name)
{
  constexpr Named<DetectionRule> kRules[] = {{DetectionRule::kAnd, "and"},
                                             {DetectionRule::kOr, "or"}};
  return fromName(kRules, "rule", name, WordList::kOr);
}

void
DetectorOptions::validate() const
{
  views.validate();
  WindowGrid{scale_factor, 0, 0}.validate();
  require(
      min_neighbours_range >= 1, "min_neighbours_range", min_neighbours_range, ">= 1");
  require(min_neighbours_reflectance >= 1,
          "min_neighbours_reflectance",
          min_neighbours_reflectance,
          ">= 1");
  require(size_tolerance > 1, "size_tolerance", size_tolerance, "> 1");
}

ObjectDetector::ObjectDetector(HaarCascade cascade,
                               const DetectorOptions& options,
                               std::optional<HaarCascade> other)
: options_(options), views_(viewsOf(cascade, options.views))
{
  options_.views = views_.options();
  options_.validate();
  cascades_.push_back(std::move(cascade));
  if (other)
    cascades_.push_back(std::move(*other));
  checkCascades(cascades_);
}

std::vector<DetectedObject>
ObjectDetector::detect(const Points& points,
                       const std::vector<float>& reflectance) const
{
  bool has_depth = true;
  for (const auto& cascade : cascades_)
    has_depth = has_depth && (cascade.subject->channel == ImageChannel::kRange);
  if (!has_depth && reflectance.size() != points.size())
    throw BadArgument("a cascade looks at reflectances, but the scan has " +
                      std::to_string(reflectance.size()) + " for " +
                      std::to_string(points.size()) + " points");
  std::vector<std::vector<DetectedObject>> found(views_.size());
  parallelFor(views_.size(), options_.views.num_threads, [&](std::size_t view) {
    const RangeImage image = views_.image(view, points, reflectance);
    found[view] = detectIn(view, image, cascades_.front());
    if (cascades_.size() == 2)
      found[view] =
          combined(std::move(found[view]), detectIn(view, image, cascades_.back()));
    for (auto& object : found[view])
      object.points =
          pointsBehind(image, object, points, cascades_.front().subject->object_size);
  });
  std::vector<DetectedObject> all;
  for (auto& of_view : found) {
    std::stable_sort(of_view.begin(), of_view.end(), isSurer);
    std::move(of_view.begin(), of_view.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<DetectedObject>
ObjectDetector::detectIn(std::size_t view,
                         const RangeImage& image,
                         const HaarCascade& cascade) const
{
  const DetectionViewOptions& v = options_.views;
  std::vector<Hit> hits;
  if (cascade.subject->channel == ImageChannel::kReflectance) {
    hits =
        hitsOf(reflectancePicture(image), {v.min_range, v.max_range}, image, cascade);
    return grouped(hits, view, DetectionSource::kReflectance);
  }
  for (const auto& slice : views_.slices()) {
    const auto found = hitsOf(rangePicture(image, slice), slice, image, cascade);
    hits.insert(hits.end(), found.begin(), found.end());
  }
  return grouped(hits, view, DetectionSource::kRange);
}

std::vector<ObjectDetector::Hit>
ObjectDetector::hitsOf(const GrayImage& picture,
                       const DepthSlice& slice,
                       const RangeImage& image,
                       const HaarCascade& cascade) const
{
  const WindowGate gate(options_.views,
                        image,
                        slice,
                        cascade.subject->object_size,
                        options_.size_tolerance);
  const auto grid = gate.grid(options_.scale_factor);
  std::vector<Hit> hits;
  if (!grid)
    return hits;
  for (const auto& box : detectWindows(cascade, picture, *grid))
    if (const auto range = gate.rangeIn(box))
      hits.push_back({box, *range});
  return hits;
}

std::vector<DetectedObject>
ObjectDetector::grouped(const std::vector<Hit>& hits,
                        std::size_t view,
                        DetectionSource source) const
{
  struct Group {
    Hit founder;
    double x = 0, y = 0, width = 0, height = 0, range = 0;
    int count = 0;
  };
  std::vector<Group> groups;
  for (const auto& hit : hits) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return overlap(g.founder.box, hit.box) >= kSameObject &&
             std::abs(g.founder.range - hit.range) <= options_.views.slice_depth / 2;
    });
    if (group == groups.end())
      group = groups.insert(groups.end(), Group{hit});
    group->x += hit.box.x;
    group->y += hit.box.y;
    group->width += hit.box.width;
    group->height += hit.box.height;
    group->range += hit.range;
    ++group->count;
  }
  const int fewest = source == DetectionSource::kRange
                         ? options_.min_neighbours_range
                         : options_.min_neighbours_reflectance;
  std::vector<DetectedObject> objects;
  for (const auto& g : groups)
    if (g.count >= fewest) {
      const auto mean = [&](double sum) {
        return static_cast<int>(std::floor(sum / g.count + 0.5));
      };
      DetectedObject object;
      object.view = view;
      object.box = {mean(g.x), mean(g.y), mean(g.width), mean(g.height)};
      object.score = g.count;
      object.source = source;
      object.range = g.range / g.count;
      objects.push_back(object);
    }
  return objects;
}

bool
ObjectDetector::areOne(const DetectedObject& a, const DetectedObject& b) const
{
  constexpr double kOverlap = 0.3; // the channels locate edges differently
  return overlap(a.box, b.box) >= kOverlap &&
         std::abs(a.range - b.range) <= options_.views.slice_depth / 2;
}

std::vector<DetectedObject>
ObjectDetector::combined(std::vector<DetectedObject> a,
                         const std::vector<DetectedObject>& b) const
{
  const std::size_t of_first = a.size();
  for (const auto& other : b) {
    DetectedObject* same = nullptr; // detection with the largest overlap
    for (std::size_t i = 0; i < of_first; ++i)
      if (areOne(a[i], other) &&
          (!same || overlap(a[i].box, other.box) > overlap(same->box, other.box)))
        same = &a[i];
    if (same) {
      same->score += other.score;
      same->source = DetectionSource::kBoth;
    }
    else
      a.push_back(other);
  }
  if (options_.rule == DetectionRule::kAnd)
    a.erase(std::remove_if(a.begin(),
                           a.end(),
                           [](const DetectedObject& o) {
                             return o.source != DetectionSource::kBoth;
                           }),
            a.end());
  return a;
}

} // namespace pcl6d
