// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::sources {

/** \brief An XML element with attributes, text and children. */
struct XmlElement {
  std::string name; ///< with the prefix
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text; ///< of the element itself
  std::vector<XmlElement> children;
  std::size_t line = 0;    ///< where it begins
  std::uint64_t begin = 0; ///< [byte] of the XML section, of "<name"
  std::uint64_t end = 0;   ///< behind "</name>"

  /** \return the attribute, or null */
  const std::string*
  attribute(const std::string& attribute_name) const;

  /** \return the first child with the name, or null */
  const XmlElement*
  child(const std::string& child_name) const;
};

/** \brief Fills a block of bytes. \return how many, 0 at the end */
using XmlBytes = std::function<std::size_t(char* target, std::size_t size)>;

/** \brief Reads the elements of an XML text selected by `keeps`; rejected elements are skipped
 * with all children. Entities are not expanded: a text with a document type is rejected.
 * \param[in] keeps called with the name and the enclosing elements
 * \throws IoFailed naming the line: malformed XML, nested more than 200 deep, a document type,
 * more than a million elements */
XmlElement
readXml(const std::filesystem::path& path,
        const XmlBytes& bytes,
        const std::function<bool(const std::string& name,
                                 const std::vector<XmlElement>& above)>& keeps);

} // namespace pcl6d::sources
