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

/** \brief Orientation required by a label. */
enum class Orientation { kAny, kHorizontal, kVertical };

/** \brief The side of a plane that the sensor must have seen. */
enum class SeenFrom { kAnywhere, kAbove, kBelow };

/** \brief A measure with a required range; an unknown measure satisfies every range. */
struct Condition {
  Measure measure = Measure::kArea;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/** \brief A label and its conditions on a single plane. */
struct LabelRule {
  std::string name;
  Orientation orientation = Orientation::kAny;
  SeenFrom seen_from = SeenFrom::kAnywhere;
  std::vector<Condition> conditions;
};

/** \brief A relation required between every plane with the first and every plane with
 * the second label. */
struct PairRule {
  static constexpr std::size_t kEveryOther = static_cast<std::size_t>(-1);
  std::size_t first = 0;  ///< index into LabelRules::labels
  std::size_t second = 0; ///< index into LabelRules::labels, or kEveryOther than first
  RelationRule rule;
  std::string place; ///< position in the rule file

  /** \return whether the rule binds planes with the labels a and b, in order */
  bool
  binds(std::size_t a, std::size_t b) const
  {
    return first == a && (second == b || (second == kEveryOther && a != b));
  }
};

/** \brief A plane with this label needs a partner in this relation. */
struct NeedRule {
  std::size_t label = 0;   ///< index into LabelRules::labels
  std::size_t partner = 0; ///< index into LabelRules::labels
  RelationRule rule;       ///< of the plane to its partner
  std::string place;       ///< position in the rule file
};

/** \brief A semantic network as data (book 7.1.2): the labels, preferred in their order
 * at equal area, and the constraints among them. "none" is not in the list; it fits
 * every plane and is compatible with every label. \ingroup scene_interpretation */
struct LabelRules {
  std::string name;
  std::vector<LabelRule> labels;
  std::vector<PairRule> pairs;
  std::vector<NeedRule> needs;

  /** \return the index of a label; labels.size() if it is unknown */
  std::size_t
  find(const std::string& label) const;
};

/** \return the number of a label in the field `label` of a point: 0 to 4 see
 * PlaneLabel, then the other labels of the rules by their order
 * \throws BadArgument the rules do not know the label */
unsigned int
labelNumber(const LabelRules& rules, const std::string& label);

/** \return the book's network: floor, ceiling, door, wall; share/rules/book.json */
const LabelRules&
bookRules();

/** \brief Reads rules from a JSON file; format: share/doc/planes.md, "Labels".
 * \throws IoFailed naming file, position (JSON pointer) and rule: not readable, unknown
 * keys, measures, relations or labels, and contradictory rules */
LabelRules
readLabelRules(const std::filesystem::path& path);

/** \brief Reads rules from JSON text. \param[in] name for messages, in place of the
 * file */
LabelRules
parseLabelRules(const std::string& json, const std::string& name);

} // namespace pcl6d
