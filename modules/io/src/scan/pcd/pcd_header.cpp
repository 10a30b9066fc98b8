// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/usual_names.h"
#include "trajectory/rigid_pose.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>
#include <istream>
#include <limits>
#include <map>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

constexpr std::size_t kMaxPoints = std::numeric_limits<pcl::uindex_t>::max();

/** How a PCD file spells a datatype. */
struct TypeName {
  std::uint8_t datatype;
  char type;
  std::size_t size; ///< [byte]
};
constexpr std::array<TypeName, 10> kTypes = {{{PCLPointField::INT8, 'I', 1},
                                              {PCLPointField::UINT8, 'U', 1},
                                              {PCLPointField::INT16, 'I', 2},
                                              {PCLPointField::UINT16, 'U', 2},
                                              {PCLPointField::INT32, 'I', 4},
                                              {PCLPointField::UINT32, 'U', 4},
                                              {PCLPointField::INT64, 'I', 8},
                                              {PCLPointField::UINT64, 'U', 8},
                                              {PCLPointField::FLOAT32, 'F', 4},
                                              {PCLPointField::FLOAT64, 'F', 8}}};

constexpr std::size_t kLongestLine = 1 << 16; // [byte] longer: not a header
const char* const kWords[] = {"VERSION",
                              "FIELDS",
                              "SIZE",
                              "TYPE",
                              "COUNT",
                              "WIDTH",
                              "HEIGHT",
                              "VIEWPOINT",
                              "POINTS",
                              "DATA"};

/** \brief The entries of a PCD header by first word, before interpretation. */
class Entries {
public:
  /** \brief Reads up to and including the line DATA. \param[in] path kept for the
   * messages \throws IoFailed unknown or repeated entry, or no DATA */
  Entries(std::istream& stream, const std::filesystem::path& path);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }
  std::size_t
  numLines() const
  {
    return num_lines_;
  }
  bool
  has(std::string_view word) const
  {
    return entries_.count(word) > 0;
  }

  /** \return the values after the word \throws IoFailed the entry is missing */
  const std::vector<std::string>&
  values(std::string_view word) const;

  /** \return the values of an entry with a required count */
  const std::vector<std::string>&
  values(std::string_view word, std::size_t count) const;

  /** \return a value of the entry as a number */
  template <typename T>
  T
  number(std::string_view word, const std::string& token) const
  {
    T value{};
    if (!text::parseNumber(token, value))
      fail(word,
           std::string(word) + " " + text::quoted(token) + " is not " +
               (std::is_integral_v<T> ? "a whole number >= 0" : "a number"));
    return value;
  }

  /** \return the line number of the entry */
  std::size_t
  lineOf(std::string_view word) const;

  /** \throws IoFailed with the line of the entry */
  [[noreturn]] void
  fail(std::string_view word, const std::string& message) const;

private:
  struct Entry {
    std::size_t line = 0;
    std::vector<std::string> values;
  };

  bool
  readLine(std::istream& stream, std::string& line) const;
  void
  add(const std::string& line);

  std::filesystem::path path_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::size_t num_lines_ = 0;
};

Entries::Entries(std::istream& stream, const std::filesystem::path& path) : path_(path)
{
  std::string line;
  while (!has("DATA")) {
    if (!readLine(stream, line))
      text::fail(path_, "the header ends without a DATA line");
    ++num_lines_;
    add(line);
  }
}

const std::vector<std::string>&
Entries::values(std::string_view word) const
{
  const auto entry = entries_.find(word);
  if (entry == entries_.end())
    text::fail(path_, "the header has no " + std::string(word));
  return entry->second.values;
}

const std::vector<std::string>&
Entries::values(std::string_view word, std::size_t count) const
{
  const auto& all = values(word);
  if (all.size() != count)
    fail(word,
         "expected " + text::counted(count, "value") + " after " + std::string(word) +
             ", got " + std::to_string(all.size()));
  return all;
}

std::size_t
Entries::lineOf(std::string_view word) const
{
  return entries_.find(word)->second.line;
}

void
Entries::fail(std::string_view word, const std::string& message) const
{
  const auto entry = entries_.find(word);
  if (entry == entries_.end())
    text::fail(path_, message);
  text::failAt(path_, entry->second.line, message);
}

bool
Entries::readLine(std::istream& stream, std::string& line) const
{
  line.clear();
  char c = 0;
  while (stream.get(c) && c != '\n') {
    line += c;
    if (line.size() > kLongestLine)
      text::failAt(path_, num_lines_ + 1, "not a line of a PCD header");
  }
  return stream.good() || !line.empty(); // the last line may lack a line end
}

void
Entries::add(const std::string& line)
{
  text::Tokens tokens(line, "\r");
  std::string word(tokens.next());
  if (word.empty() || word.front() == '#')
    return;
  if (word == "COLUMNS") // the oldest files
    word = "FIELDS";
  if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords))
    text::failAt(
        path_, num_lines_, text::quoted(word) + " is not an entry of a PCD header");
  if (has(word))
    text::failAt(path_, num_lines_, "a second " + word);
  Entry& entry = entries_[word];
  entry.line = num_lines_;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next())
    entry.values.emplace_back(token);
}

const std::map<std::string, PcdEncoding, std::less<>> kEncodings = {
    {"ascii", PcdEncoding::kAscii},
    {"binary", PcdEncoding::kBinary},
    {"binary_compressed", PcdEncoding::kBinaryCompressed}};

std::uint8_t
datatypeOf(const Entries& entries, const std::string& type, const std::string& size)
{
  for (const auto& known : kTypes)
    if (type == std::string(1, known.type) && size == std::to_string(known.size))
      return known.datatype;
  entries.fail("TYPE",
               "no field has TYPE " + text::quoted(type) + " and SIZE " +
                   text::quoted(size) + " (known: I and U of 1, 2, 4, 8; F of 4, 8)");
}

/** \return how many values a field has; zero or less only for a gap, see readFields() */
std::int64_t
countOf(const Entries& entries, const std::string& name, const std::string& token)
{
  if (name == "_" && token.front() == '-')
    return entries.number<std::int32_t>("COUNT", token);
  const auto count = entries.number<std::uint32_t>("COUNT", token);
  if (count == 0 && name != "_") // drivers write gaps of size 0; dropped by PCL too
    entries.fail("COUNT", "COUNT of field " + text::quoted(name) + " is 0");
  return count;
}

/** PCL's writer joins fields out of offset order by gaps of negative length; such gaps move
 * backwards and are not fields here. */
void
readFields(const Entries& entries, PcdHeader& header)
{
  const auto& names = entries.values("FIELDS");
  if (names.empty())
    entries.fail("FIELDS", "FIELDS names no field");
  const auto& sizes = entries.values("SIZE", names.size());
  const auto& types = entries.values("TYPE", names.size());
  const std::vector<std::string> counts =
      entries.has("COUNT") ? entries.values("COUNT", names.size())
                           : std::vector<std::string>(names.size(), "1");
  std::int64_t offset = 0;
  std::int64_t end = 0; // of the last field
  for (std::size_t i = 0; i < names.size(); ++i) {
    PCLPointField field;
    field.name = names[i];
    field.datatype = datatypeOf(entries, types[i], sizes[i]);
    field.offset = static_cast<pcl::uindex_t>(offset);
    const std::int64_t count = countOf(entries, names[i], counts[i]);
    offset += count * static_cast<std::int64_t>(sizeOfType(field.datatype));
    end = std::max(end, offset);
    if (offset < 0 || end > kMaxPointSize)
      entries.fail("FIELDS",
                   "a point has more than " + std::to_string(kMaxPointSize) +
                       " bytes, or a gap leads ahead of the start of the point");
    field.count = static_cast<pcl::uindex_t>(count);
    if (count > 0)
      header.fields.push_back(field);
  }
  if (offset < end)
    entries.fail("COUNT", "a field ends behind the point");
  header.point_size = static_cast<std::size_t>(offset);
  takeUsualNames(header.fields);
}

std::size_t
readCount(const Entries& entries, std::string_view word)
{
  return entries.number<std::uint64_t>(word, entries.values(word, 1).front());
}

void
readShape(const Entries& entries, PcdHeader& header)
{
  header.width = readCount(entries, entries.has("WIDTH") ? "WIDTH" : "POINTS");
  header.height = entries.has("HEIGHT") ? readCount(entries, "HEIGHT") : 1;
  if (header.height != 0 && header.width > kMaxPoints / header.height)
    entries.fail(entries.has("WIDTH") ? "WIDTH" : "POINTS",
                 std::to_string(header.width) + " x " + std::to_string(header.height) +
                     " points are more than a cloud can hold");
  const std::size_t points =
      entries.has("POINTS") ? readCount(entries, "POINTS") : header.numPoints();
  if (points != header.numPoints())
    entries.fail("POINTS",
                 "POINTS " + std::to_string(points) +
                     " is not WIDTH x HEIGHT = " + std::to_string(header.numPoints()));
}

Eigen::Isometry3d
readViewpoint(const Entries& entries)
{
  if (!entries.has("VIEWPOINT"))
    return Eigen::Isometry3d::Identity();
  std::array<double, 7> v{};
  const auto& values = entries.values("VIEWPOINT", v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = entries.number<double>("VIEWPOINT", values[i]);
  if (std::all_of(v.begin(), v.end(), [](double value) { return value == 0; }))
    return Eigen::Isometry3d::Identity(); // all zero: written by programs without pose
  return rigidPose(entries.path(),
                   entries.lineOf("VIEWPOINT"),
                   Eigen::Quaterniond(v[3], v[4], v[5], v[6]),
                   Eigen::Vector3d(v[0], v[1], v[2]));
}

} // namespace

std::size_t
sizeOfType(std::uint8_t datatype)
{
  for (const auto& known : kTypes)
    if (known.datatype == datatype)
      return known.size;
  return 0;
}

PcdHeader
readPcdHeader(std::istream& stream, const std::filesystem::path& path)
{
  const Entries entries(stream, path);
  PcdHeader header;
  if (entries.has("VERSION")) {
    const auto& version = entries.values("VERSION", 1).front();
    if (!(entries.number<double>("VERSION", version) <= 0.7))
      entries.fail("VERSION",
                   "VERSION " + text::quoted(version) + " is not known (up to 0.7)");
  }
  readFields(entries, header);
  readShape(entries, header);
  header.viewpoint = readViewpoint(entries);
  const auto& encoding = entries.values("DATA", 1).front();
  const auto known = kEncodings.find(encoding);
  if (known == kEncodings.end())
    entries.fail("DATA",
                 "DATA " + text::quoted(encoding) +
                     " is not known (ascii, binary, binary_compressed)");
  header.encoding = known->second;
  header.num_lines = entries.numLines();
  return header;
}

std::string
toString(const PcdHeader& header)
{
  std::string names, sizes, types, counts;
  for (const auto& field : header.fields) {
    const auto type = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) {
      return t.datatype == field.datatype;
    });
    names += ' ' + field.name;
    sizes += ' ' + std::to_string(type->size);
    types += std::string(" ") + type->type;
    counts += ' ' + std::to_string(field.count);
  }
  std::string pose;
  const Eigen::Vector3d t = header.viewpoint.translation();
  const auto q = canonical(Eigen::Quaterniond(header.viewpoint.linear()));
  for (const double value : {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}) {
    pose += ' ';
    text::appendNumber(pose, value);
  }
  std::string encoding;
  for (const auto& [name, value] : kEncodings)
    if (value == header.encoding)
      encoding = name;
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" + names +
         "\nSIZE" + sizes + "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " +
         std::to_string(header.width) + "\nHEIGHT " + std::to_string(header.height) +
         "\nVIEWPOINT" + pose + "\nPOINTS " + std::to_string(header.numPoints()) +
         "\nDATA " + encoding + '\n';
}

} // namespace pcl6d::io
