// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scene_interpretation/relations.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A plane's way to lie that a label asks for. */
enum class Orientation { kAny, kHorizontal, kVertical };

/** \brief The side from which a label must have been seen. */
enum class SeenFrom { kAnywhere, kAbove, kBelow };

/** \brief A measure that has to lie in a range; one that is not known does. */
struct Condition {
  Measure measure = Measure::kArea;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/** \brief A label and what a single plane must be to carry it. */
struct LabelRule {
  std::string name;
  Orientation orientation = Orientation::kAny;
  SeenFrom seen_from = SeenFrom::kAnywhere;
  std::vector<Condition> conditions;
};

/** \brief Any two planes with these labels must be so related: the one with the first
 * label to the one with the second. */
struct PairRule {
  static constexpr std::size_t kEveryOther = static_cast<std::size_t>(-1);
  std::size_t first = 0;  ///< place in LabelRules::labels
  std::size_t second = 0; ///< place in LabelRules::labels, or kEveryOther than first
  RelationRule rule;
  std::string place; ///< in the file that it was read from

  /** \return whether it says something of planes with the labels a and b, in order */
  bool
  binds(std::size_t a, std::size_t b) const
  {
    return first == a && (second == b || (second == kEveryOther && a != b));
  }
};

/** \brief A plane with this label needs another one so related to it. */
struct NeedRule {
  std::size_t label = 0;   ///< place in LabelRules::labels
  std::size_t partner = 0; ///< place in LabelRules::labels
  RelationRule rule;       ///< of the plane to its partner
  std::string place;       ///< in the file that it was read from
};

/** \brief A semantic network as data (book 7.1.2): the labels, those to be preferred at
 * equal area first, and the constraints among them. "none" is no label of the list: it
 * fits every plane and is compatible with everything. \ingroup scene_interpretation */
struct LabelRules {
  std::string name;
  std::vector<LabelRule> labels;
  std::vector<PairRule> pairs;
  std::vector<NeedRule> needs;

  /** \return the place of a label; labels.size() if it is unknown */
  std::size_t
  find(const std::string& label) const;
};

/** \return the number of a label as the field `label` of a point: 0 to 4 as in
 * PlaneLabel, then the other labels of the rules by their order
 * \throws BadArgument the rules do not know the label */
unsigned int
labelNumber(const LabelRules& rules, const std::string& label);

/** \return the book's network: floor, ceiling, door, wall; share/rules/book.json */
const LabelRules&
bookRules();

/** \brief Reads rules from a JSON file; its form: share/doc/planes.md, "Labels".
 * \throws IoFailed naming file, place (JSON pointer) and rule: not readable, unknown
 * keys, measures, relations or labels, and rules that contradict each other */
LabelRules
readLabelRules(const std::filesystem::path& path);

/** \brief The same from text. \param[in] name for messages, in place of the file */
LabelRules
parseLabelRules(const std::string& json, const std::string& name);

} // namespace pcl6d
