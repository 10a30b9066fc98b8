// SPDX-License-Identifier: BSD-3-Clause
#include "control_json.h"
#include "rejection_json.h"
#include "schema_keys.h"
#include "summary_reader.h"
#include "verification_json.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_fields.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

namespace pcl6d::run_files {

namespace {
using Covariance = std::optional<Eigen::Matrix<double, 6, 6>>;

constexpr const char* kProgram = "pcl_slam6d";

// Tolerance of poses and covariances, which are written exactly: rounding in products of poses and
// in inverses is smaller, the effect of a changed number is far larger.
constexpr double kRounding = 1e-6;

bool
isControl(char c)
{
  return static_cast<unsigned char>(c) < ' ' || c == '\x7f';
}

/** \return whether the name is a file name in a folder, without a path out of the folder */
bool
isFileName(const std::string& name)
{
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string("/\0", 2)) == std::string::npos;
}

Eigen::Isometry3d
poseFrom(const JsonValue& json)
{
  Eigen::Isometry3d pose = json.pose();
  json.require(isRigid(pose, kRounding), "a rigid motion");
  return pose;
}

Covariance
covarianceFrom(const JsonValue& json)
{
  if (json.isNull())
    return {};
  const auto rows = json.elements();
  json.require(rows.size() == 6, "six rows of six numbers, or null");
  for (const JsonValue& row : rows)
    row.require(row.isArray() && row.elements().size() == 6, "six numbers");
  const Eigen::Matrix<double, 6, 6> covariance = json.matrix6();
  const double rounding = kRounding * covariance.cwiseAbs().maxCoeff();
  json.require((covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= rounding,
               "symmetric");
  json.require(symmetricEigenvalues<6>(covariance)[0] >= -rounding, // false for NaN
               "a covariance: no variance may be negative");
  return covariance;
}

/** Visitor of the fields of a result: reads the value under the name of the field, by the keys of the
 * file's version. */
struct Reader {
  const JsonValue& json;
  const SchemaKeys& keys;

  template <typename Value>
  void
  operator()(const char* name, Value& value) const
  {
    const JsonValue field = json / keys(name);
    if constexpr (std::is_enum_v<Value>)
      take(field, value);
    else if constexpr (std::is_same_v<Value, std::string>)
      value = field.text();
    else if constexpr (std::is_same_v<Value, bool>)
      value = field.boolean();
    else if constexpr (std::is_same_v<Value, std::size_t>)
      value = field.count();
    else if constexpr (std::is_same_v<Value, Covariance>)
      value = covarianceFrom(field);
    else if constexpr (std::is_same_v<Value, Eigen::Vector3d>)
      value = field.vector3();
    else
      value = poseFrom(field);
  }
  void
  operator()(const char* name, int& value) const
  {
    const JsonValue field = json / name;
    value = field.integer();
    field.require(value >= 0, ">= 0");
  }
  /** Runs of earlier versions have the words alone. */
  void
  operator()(const char* name, Rejection& value) const
  {
    const auto field = json.find(name);
    value = field ? rejectionFrom(*field) : statedReason();
  }
  void
  operator()(const char* name, std::vector<Rejection>& value) const
  {
    if (const auto field = json.find(name))
      value = rejectionsFrom(*field);
    else if (const Rejection stated = statedReason())
      value = {stated};
  }
  void
  operator()(const char* name, RecoveredBy& value) const // missing in older runs
  {
    if (const auto field = json.find(name))
      take(*field, value);
  }
  void
  operator()(const char* name, double& value) const // null: not finite
  {
    const JsonValue field = json / name;
    value = field.isNull() ? std::numeric_limits<double>::quiet_NaN() : field.number();
  }

private:
  Rejection
  statedReason() const
  {
    return Rejection::stated((json / "reason").text());
  }

  template <typename Enum>
  static void
  take(const JsonValue& field, Enum& value)
  {
    const std::string word = field.text();
    try {
      takeWord(word, value);
    } catch (const BadArgument& error) {
      field.fail(error.what());
    }
  }
};

/** Inverse of hexOf(). */
std::string
bytesFrom(const JsonValue& json)
{
  const std::string hex = json.text();
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    unsigned int byte = 0;
    const char* const end = hex.data() + std::min(i + 2, hex.size());
    const auto read = std::from_chars(hex.data() + i, end, byte, 16);
    json.require(read.ec == std::errc() && read.ptr == hex.data() + i + 2,
                 "two hexadecimal digits a byte");
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

ScanResult
scanFrom(const JsonValue& json, const SchemaKeys& keys)
{
  ScanResult scan;
  visitScanFields(scan, Reader{json, keys});
  if (const auto motion = json.find("motion"))
    visitMotionFields(scan.motion.emplace(), Reader{*motion, keys});
  const JsonValue file = json / "file";
  file.require(scan.file.empty() || json.has(kFileBytes) || isPlainName(scan.file),
               "a name without control characters");
  if (const auto bytes = json.find(kFileBytes))
    scan.file = bytesFrom(*bytes);
  file.require(isFileName(scan.file), "the name of a file, without a folder");
  return scan;
}

std::vector<ScanResult>
scansFrom(const JsonValue& json, const SchemaKeys& keys)
{
  std::vector<ScanResult> scans;
  std::set<int> indices;
  for (const JsonValue& entry : json.elements()) {
    scans.push_back(scanFrom(entry, keys));
    if (!indices.insert(scans.back().index).second)
      (entry / "index")
          .fail("there are two scans " + std::to_string(scans.back().index));
  }
  return scans;
}

std::vector<std::string>
textsFrom(const JsonValue& json)
{
  std::vector<std::string> texts;
  for (const JsonValue& text : json.elements())
    texts.push_back(text.text());
  return texts;
}

/** Restores names that JSON cannot represent from the names of the scans. */
std::vector<std::string>
floatingFrom(const JsonValue& json, const std::vector<ScanResult>& scans)
{
  std::vector<std::string> names = textsFrom(json);
  for (std::string& name : names)
    for (const ScanResult& scan : scans)
      if (!isUtf8(scan.file) && shownName(scan.file) == name)
        name = scan.file;
  return names;
}

void
readGraph(const JsonValue& json, const SchemaKeys& keys, RunResult& run)
{
  for (const JsonValue& stage : (json / "stages").elements())
    visitStageFields(run.graph_stages.emplace_back(), Reader{stage, keys});
  run.links_used = (json / "links_used").count();
  run.links_refused = (json / keys("links_rejected")).count();
  run.floating = floatingFrom(json / keys("disconnected"), run.scans);
}

RunResult::Option
optionFrom(const std::string& name, const JsonValue& json)
{
  json.require(!name.empty() && isPlainName(name), "under the name of an option");
  const auto why = json.find("why");
  return {name,
          (json / "value").text(),
          (json / "source").text(),
          why ? why->text() : std::string()};
}

/** \return whether the path stays in its folder, and is normalised */
bool
isInside(const std::string& path)
{
  const std::filesystem::path relative(path), normal = relative.lexically_normal();
  return isPlainName(path) && !path.empty() && relative.is_relative() &&
         normal.native() == path && normal.has_filename() &&
         isFileName(normal.begin()->string());
}

std::map<std::string, WrittenFile>
filesFrom(const JsonValue& json)
{
  std::map<std::string, WrittenFile> files;
  for (const std::string& name : json.keys()) {
    const JsonValue entry = json / name;
    entry.require(isInside(name), "under the path of a file in the run's folder");
    entry.allow({"bytes", "crc32"});
    WrittenFile& file = files[name];
    file.bytes = (entry / "bytes").count();
    const JsonValue sum = entry / "crc32";
    const std::string hex = sum.text();
    const char* const end = hex.data() + hex.size();
    const auto read = std::from_chars(hex.data(), end, file.crc32, 16);
    sum.require(hex.size() == 8 && read.ec == std::errc() && read.ptr == end,
                "eight hexadecimal digits");
  }
  return files;
}

void
readHead(const JsonValue& json, const SchemaKeys& keys, RunResult& run)
{
  const JsonValue generator = json / "generator";
  run.generator = generator.text();
  if (run.generator != kProgram)
    json.fail("is of " + text::quoted(run.generator) + ", not of " + kProgram);
  run.version = (json / "version").text();
  run.world_offset = (json / "world_offset").vector3();
  run.pose_source = (json / "pose_source").text();
  if (const auto moved = json.find(keys("input_offset"))) // only of large coordinates
    visitMovedFields(run.moved.emplace(), Reader{*moved, keys});
  const JsonValue verdict = json / "verdict";
  run.trusted = (verdict / keys("reliable")).boolean();
  run.complete = (verdict / "complete").boolean();
  run.verdict = (verdict / "text").text();
  run.warnings = textsFrom(json / "warnings");
  run.map_points = (json / "totals" / "map_points").count();
}
} // namespace

bool
isPlainName(const std::string& name)
{
  return isUtf8(name) && std::none_of(name.begin(), name.end(), isControl);
}

std::string
hexOf(const std::string& bytes)
{
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    hex += {kDigits[byte / 16], kDigits[byte % 16]};
  }
  return hex;
}

std::string
shownName(const std::string& name)
{
  return JsonValue::Json::parse(jsonText(name)).get<std::string>();
}

namespace {
MovingResult
movingFrom(const JsonValue& json,
           const SchemaKeys& keys,
           const std::vector<ScanResult>& scans)
{
  MovingResult moving;
  const auto points = (json / "points").elements();
  (json / "points").require(points.size() == scans.size(), "one number per scan");
  for (std::size_t i = 0; i < points.size(); ++i) {
    moving.points.push_back(points[i].count());
    points[i].require(moving.points.back() <= scans[i].points,
                      "at most the points of the scan");
  }
  moving.removed = (json / "removed").boolean();
  moving.blind = (json / keys("inconclusive")).boolean();
  moving.background = (json / "background").number();
  moving.unknown = (json / "unknown").number();
  return moving;
}

DriveResult
driveFrom(const JsonValue& json,
          const SchemaKeys& keys,
          const std::vector<ScanResult>& scans)
{
  DriveResult drive;
  drive.first = static_cast<int>((json / "first_sweep").count());
  for (const JsonValue& file : (json / "files").elements())
    drive.files.push_back(file.text());
  const auto holds = [&drive](int index) {
    return index >= drive.first && drive.placeOf(index) < drive.files.size();
  };
  for (const ScanResult& scan : scans)
    (json / "files").require(holds(scan.index), "every scan of the map and more");
  for (const JsonValue& lost : (json / "lost").elements()) {
    drive.lost.push_back(static_cast<int>(lost.count()));
    lost.require(holds(drive.lost.back()), "the index of a sweep");
  }
  drive.way = (json / keys("path_length")).number();
  drive.seconds = (json / "seconds").number();
  return drive;
}
} // namespace

RunResult
runFrom(const JsonValue& json)
{
  RunResult run;
  const SchemaKeys keys = keysOf(json / "schema_version");
  readHead(json, keys, run);
  const JsonValue options = json / "options";
  for (const std::string& name : options.keys())
    run.options.push_back(optionFrom(name, options / name));
  for (const JsonValue& stage : (json / "stages").elements())
    run.stages.push_back({(stage / "name").text(),
                          (stage / "seconds").number(),
                          (stage / "peak_memory_mb").number()});
  run.scans = scansFrom(json / "scans", keys);
  readGraph(json / "graph", keys, run);
  if (const auto verification = json.find("verification")) { // missing in older runs
    run.verification = verificationFrom(*verification, keys);
    (*verification / "scans")
        .require(run.verification->scans.size() == run.scans.size(),
                 "one check per scan");
  }
  if (const auto moving = json.find(keys("dynamic"))) // missing in older runs
    run.moving = movingFrom(*moving, keys, run.scans);
  if (const auto control = json.find("control")) // only with control points
    run.control = controlFrom(*control, run.scans.size());
  if (const auto drive = json.find("drive")) // only of keyframes
    run.drive = driveFrom(*drive, keys, run.scans);
  if (const auto files = json.find("files")) // missing in older runs
    run.files = filesFrom(*files);
  return run;
}

} // namespace pcl6d::run_files
