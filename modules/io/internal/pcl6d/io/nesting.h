// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <string>
#include <string_view>

/** \file Limit on the nesting depth of a text, checked before parsing: parsers of JSON, XML and
 * YAML recurse on each level, and a hostile file could overflow the stack. The functions scan
 * each character once and store only the open levels. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The deepest nesting accepted. Files written by people and programs have about a dozen
 * levels (groups of a drawing are the deepest). The parsers survive several thousand levels on
 * a stack of 8 MB, hence some hundreds on the stack of a thread. */
constexpr std::size_t kDeepestNesting = 200;

/** \brief Meaning of a backslash in a key of JSON. */
enum class JsonKeys {
  kEscaped, ///< escapes the next character, as in the standard
  kPlain    ///< a plain letter, as in OpenCV; keys with a backslash are rejected
};

/** \brief Looks at JSON, with or without comments: [...] and {...}.
 * \param[in] name of the file, for the message
 * \throws IoFailed "name: line 12: nested more than 200 deep" */
void
checkJsonNesting(std::string_view text,
                 const std::string& name,
                 JsonKeys keys = JsonKeys::kEscaped);

/** \brief Checks XML: elements. \throws IoFailed under the conditions of checkJsonNesting() */
void
checkXmlNesting(std::string_view text, const std::string& name);

/** \brief Checks YAML as read by OpenCV: [...], {...}, and blocks, opened by indentation or in
 * sequence on a line ("- - - a"). \throws IoFailed under the conditions of checkJsonNesting(),
 * and for syntax outside OpenCV's YAML, naming the line */
void
checkYamlNesting(std::string_view text, const std::string& name);

} // namespace pcl6d
