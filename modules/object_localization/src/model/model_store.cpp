// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/training_images.h>

#include <algorithm>
#include <sstream>

namespace pcl6d {
namespace {
namespace fs = std::filesystem;
constexpr const char* kModelFile = "model.json";
constexpr double kSymmetryError = 0.015; // of the diameter

Eigen::Vector3f
turnedUp(const Eigen::Vector3f& v, UpAxis up)
{
  return up == UpAxis::kZ ? v : Eigen::Vector3f(v.x(), -v.z(), v.y());
}

/** \return the normals of a cloud; empty if the cloud has no normals */
Normals
normalsOf(const Scan& scan, UpAxis up)
{
  const auto x = fieldValues(scan.cloud, "normal_x");
  const auto y = fieldValues(scan.cloud, "normal_y");
  const auto z = fieldValues(scan.cloud, "normal_z");
  Normals normals;
  if (x && y && z)
    for (std::size_t i = 0; i < scan.points.size(); ++i)
      normals.push_back(turnedUp(
          Eigen::Vector3d(x->values[i], y->values[i], z->values[i]).cast<float>(), up));
  return normals;
}

StoredModel
cloudModel(const Scan& scan, const std::string& object_class, const MeshOptions& units)
{
  Points points;
  for (const auto& p : scan.points)
    points.push_back(turnedUp(p * static_cast<float>(units.scale), units.up));
  ObjectModel model =
      ObjectModel::fromCloud(object_class, points, normalsOf(scan, units.up));
  TriangleMesh mesh = meshOfPoints(model);
  return {std::move(model), std::move(mesh), false, {}, {}};
}

StoredModel
readShape(const fs::path& file,
          const std::string& object_class,
          const MeshOptions& units)
try {
  if (scanFormatOfExtension(file) != ScanFormat::kAuto)
    if (const Scan scan = readScan(file); scan.left_out.empty()) // a PLY without faces
      return cloudModel(scan, object_class, units);
  TriangleMesh mesh = readMesh(file, units);
  ObjectModel model = ObjectModel::fromMesh(object_class, mesh);
  return {std::move(model), std::move(mesh), true, {}, {}};
} catch (const BadArgument& e) {
  throw IoFailed(file.string() + ": " + e.what());
}

/** Reads a model.json and the files named there. */
class ModelReader {
public:
  explicit ModelReader(const fs::path& folder)
  : folder_(folder), json_(readJson(folder / kModelFile))
  {}

  StoredModel
  read()
  {
    int version = 1;
    json_.read("schema_version", version);
    if (version != 1)
      json_.fail("schema_version", std::to_string(version) + ", but must be 1");
    const std::string object_class = readClass();
    const MeshOptions units = readUnits();
    const ObjectSymmetry symmetry = readSymmetry();
    const auto shape = fileOf(json_, "file");
    if (!shape)
      json_.fail("key 'file' is missing");
    std::optional<fs::path> range, reflectance;
    if (const auto cascades = json_.member("cascades")) {
      range = fileOf(*cascades, "range");
      reflectance = fileOf(*cascades, "reflectance");
      cascades->allow({"range", "reflectance"});
    }
    json_.allow(
        {"schema_version", "class", "scale", "up", "symmetry", "file", "cascades"});
    StoredModel stored = readShape(*shape, object_class, units);
    stored.range_cascade = range;
    stored.reflectance_cascade = reflectance;
    checkSymmetry(stored, symmetry);
    stored.model.setSymmetry(symmetry);
    return stored;
  }

private:
  std::string
  readClass()
  {
    const auto object_class = json_.get<std::string>("class");
    try {
      checkObjectClass(object_class);
    } catch (const BadArgument& e) {
      json_.fail("class", e.what());
    }
    return object_class;
  }

  MeshOptions
  readUnits()
  {
    MeshOptions units;
    json_.read("scale", units.scale);
    if (!(units.scale > 0))
      json_.fail("scale", std::to_string(units.scale) + ", but must be > 0");
    std::string up = "z";
    json_.read("up", up);
    if (up != "y" && up != "z")
      json_.fail("up", "'" + up + "', but must be y or z");
    units.up = up == "y" ? UpAxis::kY : UpAxis::kZ;
    return units;
  }

  ObjectSymmetry
  readSymmetry()
  {
    std::string name = "none";
    json_.read("symmetry", name);
    try {
      return symmetryFromName(name);
    } catch (const BadArgument& e) {
      json_.fail("symmetry", e.what());
    }
  }

  std::optional<fs::path>
  fileOf(const JsonValue& json, const std::string& key) const
  {
    if (!json.has(key))
      return {};
    const auto name = json.get<std::string>(key);
    std::error_code error;
    if (name.empty() || !fs::is_regular_file(folder_ / name, error))
      json.fail(key, "no file '" + name + "' in " + folder_.string());
    return folder_ / name;
  }

  // Only for meshes: a cloud may show one side of a round object only.
  void
  checkSymmetry(const StoredModel& stored, const ObjectSymmetry& symmetry) const
  {
    const double error = symmetryError(stored.model.surface(), symmetry);
    if (!stored.has_mesh || error <= kSymmetryError * stored.model.diameter())
      return;
    std::ostringstream message;
    message << "'" << toString(symmetry)
            << "', but turned so about the z axis the mesh "
            << "is " << error << " m off itself in the mean";
    json_.fail("symmetry", message.str());
  }

  fs::path folder_;
  JsonValue json_;
};
} // namespace

void
checkObjectClass(const std::string& object_class)
{
  constexpr std::size_t kLongest = 64;
  const auto isLetter = [](unsigned char c) {
    return c >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9');
  };
  const auto isPart = [&](unsigned char c) {
    return isLetter(c) || c == '-' || c == '_' || c == '.';
  };
  const bool is_name = !object_class.empty() && object_class.size() <= kLongest &&
                       isLetter(static_cast<unsigned char>(object_class.front())) &&
                       std::all_of(object_class.begin(), object_class.end(), isPart);
  if (is_name && isUtf8(object_class))
    return;
  throw BadArgument(
      "class = " + jsonText(object_class.substr(0, kLongest)) +
      ", but must be 1 to 64 letters, digits, '-', '_' and '.', the first "
      "a letter or a digit");
}

StoredModel
readModelFile(const fs::path& file, const ModelFileOptions& options)
{
  if (options.object_class) {
    checkObjectClass(*options.object_class);
    return readShape(file, *options.object_class, options.units);
  }
  try {
    checkObjectClass(file.stem().string());
  } catch (const BadArgument& e) {
    throw IoFailed(file.string() + ": " + e.what() +
                   ": rename the file, or give the class");
  }
  return readShape(file, file.stem().string(), options.units);
}

StoredModel
readStoredModel(const fs::path& path)
{
  std::error_code error;
  return fs::is_directory(path, error) ? ModelReader(path).read() : readModelFile(path);
}

std::vector<fs::path>
listModels(const fs::path& store)
{
  std::vector<fs::path> models;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(store, error))
    if (std::error_code missing;
        fs::is_regular_file(entry.path() / kModelFile, missing))
      models.push_back(entry.path());
  if (error)
    throw IoFailed(store.string() + ": " + error.message());
  if (models.empty())
    throw IoFailed(store.string() + ": holds no folder with a " + kModelFile);
  std::sort(models.begin(), models.end());
  return models;
}

std::vector<StoredModel>
readModels(const std::vector<std::string>& paths,
           const std::filesystem::path& store,
           const ModelFileOptions& options)
{
  std::vector<StoredModel> models;
  for (const auto& path : paths)
    models.push_back(std::filesystem::is_directory(path)
                         ? readStoredModel(path)
                         : readModelFile(path, options));
  if (!store.empty())
    for (const auto& folder : listModels(store))
      models.push_back(readStoredModel(folder));
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (models[i].model.objectClass() == models[j].model.objectClass())
        throw BadArgument("two models are of the class '" +
                          models[i].model.objectClass() +
                          "': give a single model with this name, or rename a folder's "
                          "model in model.json, or rename the file");
  return models;
}

} // namespace pcl6d
