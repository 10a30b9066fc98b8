// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <string>
#include <string_view>

/** \file How deep a text is nested, looked at before a parser reads it: those of JSON, XML
 * and YAML call themselves for each level, and each level of a hostile file costs them a
 * piece of the stack until the process dies. The functions here take one look at each
 * character and keep no more than the levels that are open. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The deepest nesting that is read. Files that people and programs write have about
 * a dozen levels (the groups of a drawing being the deepest); the parsers survive several
 * thousand in a stack of 8 MB, and so some hundreds in that of a thread. */
constexpr std::size_t kDeepestNesting = 200;

/** \brief What a backslash means in a key of JSON. */
enum class JsonKeys {
  kEscaped, ///< it hides the next character, as the standard has it
  kPlain    ///< to OpenCV it is a letter there; such a key is refused
};

/** \brief Looks at JSON, with or without comments: [...] and {...}.
 * \param[in] name of the file, for the message
 * \throws IoFailed "name: line 12: nested more than 200 deep" */
void
checkJsonNesting(std::string_view text,
                 const std::string& name,
                 JsonKeys keys = JsonKeys::kEscaped);

/** \brief Looks at XML: elements. \throws IoFailed as checkJsonNesting() */
void
checkXmlNesting(std::string_view text, const std::string& name);

/** \brief Looks at YAML as OpenCV reads it: [...], {...}, and blocks, which open by their
 * indentation or one behind the other in a line ("- - - a"). \throws IoFailed as
 * checkJsonNesting(), and for a text that this YAML does not know, naming the line */
void
checkYamlNesting(std::string_view text, const std::string& name);

} // namespace pcl6d
