// SPDX-License-Identifier: BSD-3-Clause
#include "segment/segment_formats.h"

#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace pcl6d::io {

namespace {
using Tree = boost::property_tree::ptree;
using Line = std::vector<Eigen::Vector2d>;

constexpr std::size_t kLongestName = 40; // of an element, shown unabridged in messages

/** \return the name without the namespace prefix */
std::string
localName(const std::string& name)
{
  return name.substr(name.find(':') + 1); // npos + 1 is 0
}

/** The numbers and letters of a path's data, e.g. "M1-2l.5.5z". */
class PathTokens {
public:
  explicit PathTokens(std::string_view data) : rest_(data) {}

  /** \return the next letter, if a letter comes next */
  std::optional<char>
  takeLetter()
  {
    skip(" \t\r\n,");
    if (rest_.empty() || !isLetter(rest_.front()))
      return std::nullopt;
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }

  bool
  atEnd()
  {
    skip(" \t\r\n,");
    return rest_.empty();
  }

  double
  number()
  {
    skip(" \t\r\n,");
    std::string_view digits = rest_;
    if (digits.size() > 1 && digits.front() == '+')
      digits.remove_prefix(1); // from_chars rejects a plus
    double value = 0;
    const char* const end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, value);
    if (result.ec != std::errc() || !std::isfinite(value))
      throw std::invalid_argument("expected a finite number at " +
                                  text::quoted(rest_.substr(0, 20)));
    rest_ = {result.ptr, static_cast<std::size_t>(end - result.ptr)};
    return value;
  }

private:
  static bool
  isLetter(char c)
  {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }

  void
  skip(const char* characters)
  {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(characters), rest_.size()));
  }

  std::string_view rest_;
};

/** Draws the data of a path (SVG 1.1, chapter 8). */
class PathReader {
public:
  PathReader(const std::string& data, Segments& segments)
  : tokens_(data), segments_(segments)
  {}

  void
  read()
  {
    char command = 0;
    while (!tokens_.atEnd()) {
      if (const auto letter = tokens_.takeLetter())
        command = *letter;
      else if (command == 'M' || command == 'm') // further pairs are lines
        command = command == 'M' ? 'L' : 'l';
      else if (command == 'Z' || command == 'z')
        throw std::invalid_argument("a number after Z");
      draw(command);
    }
  }

private:
  void
  draw(char command)
  {
    const bool relative = command >= 'a';
    const Eigen::Vector2d from = relative ? here_ : Eigen::Vector2d(0, 0);
    switch (command) {
    case 'M':
    case 'm':
      here_ = start_ = from + point();
      has_start_ = true;
      return;
    case 'L':
    case 'l':
      return lineTo(from + point());
    case 'H':
    case 'h':
      return lineTo({from.x() + tokens_.number(), here_.y()});
    case 'V':
    case 'v':
      return lineTo({here_.x(), from.y() + tokens_.number()});
    case 'Z':
    case 'z':
      return lineTo(start_);
    case 0:
      throw std::invalid_argument("data must begin with M");
    default:
      throw std::invalid_argument(
          std::string("command ") + command +
          ", but only M L H V Z are read; turn curves into lines first");
    }
  }

  Eigen::Vector2d
  point()
  {
    const double x = tokens_.number();
    return {x, tokens_.number()};
  }

  void
  lineTo(const Eigen::Vector2d& there)
  {
    if (!has_start_)
      throw std::invalid_argument("data must begin with M");
    segments_.push_back({here_, there});
    here_ = there;
  }

  PathTokens tokens_;
  Segments& segments_;
  Eigen::Vector2d here_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  bool has_start_ = false;
};

double
numberOf(const Tree& element, const std::string& attribute, const char* otherwise)
{
  const std::string value = element.get("<xmlattr>." + attribute, otherwise);
  double number = 0;
  if (!text::parseNumber(value, number) || !std::isfinite(number))
    throw std::invalid_argument(attribute + " = " + text::quoted(value) +
                                ", but must be a finite number without a unit");
  return number;
}

Line
pointsOf(const Tree& element)
{
  const std::string value = element.get("<xmlattr>.points", "");
  PathTokens tokens(value);
  Line line;
  while (!tokens.atEnd()) {
    const double x = tokens.number();
    line.emplace_back(x, tokens.number());
  }
  return line;
}

Line
cornersOf(const Tree& rect)
{
  const Eigen::Vector2d low(numberOf(rect, "x", "0"), numberOf(rect, "y", "0"));
  const double width = numberOf(rect, "width", "");
  const double height = numberOf(rect, "height", "");
  return {low,
          low + Eigen::Vector2d(width, 0),
          low + Eigen::Vector2d(width, height),
          low + Eigen::Vector2d(0, height)};
}

/** Appends the lines of an element. */
void
readShape(const std::string& name, const Tree& element, Segments& segments)
{
  if (name == "path") {
    const std::string data = element.get("<xmlattr>.d", "");
    PathReader(data, segments).read();
  }
  else if (name == "line")
    segments.push_back({{numberOf(element, "x1", "0"), numberOf(element, "y1", "0")},
                        {numberOf(element, "x2", "0"), numberOf(element, "y2", "0")}});
  else if (name == "polyline")
    appendLine(pointsOf(element), false, segments);
  else if (name == "polygon")
    appendLine(pointsOf(element), true, segments);
  else if (name == "rect")
    appendLine(cornersOf(element), true, segments);
  else if (name == "circle" || name == "ellipse" || name == "use")
    throw std::invalid_argument(
        "is not read; convert the shape to a path of lines first");
}

bool
isDrawn(const std::string& name)
{
  for (const char* other : {"defs", "clipPath", "mask", "marker", "pattern", "symbol"})
    if (name == other)
      return false;
  return true;
}

void
readChildren(const Tree& parent, Segments& segments, std::string& place)
{
  for (const auto& [full_name, element] : parent) {
    const std::string name = localName(full_name);
    if (!isDrawn(name))
      continue;
    place = "element " + (name.size() > kLongestName ? text::quoted(name) : name);
    const std::string id = element.get("<xmlattr>.id", "");
    if (!id.empty())
      place += " with id " + text::quoted(id);
    place += ": ";
    if (element.get_child_optional("<xmlattr>.transform"))
      throw std::invalid_argument("attribute transform is not read; apply the "
                                  "transform to the coordinates first");
    readShape(name, element, segments);
    readChildren(element, segments, place);
  }
}
} // namespace

Segments
segmentsOfSvg(const std::string& content, const std::filesystem::path& path)
{
  checkXmlNesting(content, path.string());
  Segments segments;
  std::string place;
  try {
    Tree tree;
    std::istringstream stream(content);
    boost::property_tree::read_xml(
        stream, tree, boost::property_tree::xml_parser::no_comments);
    if (tree.size() != 1 || localName(tree.front().first) != "svg")
      text::fail(path, "the outermost element must be svg");
    readChildren(tree.front().second, segments, place);
  } catch (const boost::property_tree::xml_parser_error& error) {
    text::failAt(path, error.line(), error.message());
  } catch (const std::invalid_argument& error) {
    text::fail(path, place + error.what());
  }
  for (auto& segment : segments) { // y points down in SVG; 0 - y makes no -0
    segment.a.y() = 0 - segment.a.y();
    segment.b.y() = 0 - segment.b.y();
  }
  return segments;
}

} // namespace pcl6d::io
