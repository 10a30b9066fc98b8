// SPDX-License-Identifier: BSD-3-Clause
#include "e57/xml_tree.h"

#include <pcl6d/io/nesting.h>
#include <pcl6d/io/text.h>

#include <array>
#include <exception>
#include <expat.h>
#include <memory>

namespace pcl6d::sources {

const std::string*
XmlElement::attribute(const std::string& attribute_name) const
{
  for (const auto& [name_of, value] : attributes)
    if (name_of == attribute_name)
      return &value;
  return nullptr;
}

const XmlElement*
XmlElement::child(const std::string& child_name) const
{
  for (const auto& one : children)
    if (one.name == child_name)
      return &one;
  return nullptr;
}

namespace {

/** A thousand stations have about a hundred thousand elements of some hundred bytes each. */
constexpr std::size_t kMostElements = 1000000;

using KeepsElement =
    std::function<bool(const std::string&, const std::vector<XmlElement>&)>;

/** \brief Builds the tree from the events of expat, a C library: no exception may pass through
 * expat. */
class TreeBuilder {
public:
  explicit TreeBuilder(const KeepsElement& keeps)
  : keeps_(keeps), parser_(XML_ParserCreate(nullptr), XML_ParserFree)
  {
    if (!parser_)
      throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), onStart, onEnd);
    XML_SetCharacterDataHandler(parser_.get(), onText);
    XML_SetStartDoctypeDeclHandler(parser_.get(), onDoctype);
  }

  /** \return false for malformed or rejected text */
  bool
  parse(const char* data, std::size_t size, bool is_last)
  {
    const auto status =
        XML_Parse(parser_.get(), data, static_cast<int>(size), is_last ? 1 : 0);
    if (failure_)
      std::rethrow_exception(failure_);
    return status == XML_STATUS_OK;
  }

  std::size_t
  line() const
  {
    return XML_GetCurrentLineNumber(parser_.get());
  }

  /** \return why the text was rejected; empty for malformed XML */
  const std::string&
  reason() const
  {
    return reason_;
  }

  XmlElement
  take()
  {
    return std::move(root_);
  }

private:
  template <typename Call>
  static void
  guarded(void* data, Call&& call)
  {
    auto& self = *static_cast<TreeBuilder*>(data);
    if (self.failure_ || !self.reason_.empty())
      return;
    try {
      call(self);
    } catch (...) {
      self.failure_ = std::current_exception();
      XML_StopParser(self.parser_.get(), XML_FALSE);
    }
  }

  static void
  onStart(void* data, const char* name, const char** attributes)
  {
    guarded(data, [&](TreeBuilder& self) { self.start(name, attributes); });
  }
  static void
  onEnd(void* data, const char*)
  {
    guarded(data, [](TreeBuilder& self) { self.finish(); });
  }
  static void
  onText(void* data, const char* text, int size)
  {
    guarded(data, [&](TreeBuilder& self) {
      if (self.left_out_ == 0)
        self.open_.back().text.append(text, static_cast<std::size_t>(size));
    });
  }
  static void
  onDoctype(void* data, const char*, const char*, const char*, int)
  {
    guarded(data, [](TreeBuilder& self) {
      self.refuse("declares a document type, but E57 has no document type");
    });
  }

  void
  refuse(const std::string& reason)
  {
    reason_ = reason;
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void
  start(const char* name, const char** attributes)
  {
    if (open_.size() + left_out_ >= kDeepestNesting)
      return refuse("nested more than " + std::to_string(kDeepestNesting) + " deep");
    if (left_out_ > 0 || !keeps_(name, open_)) {
      ++left_out_;
      return;
    }
    if (++count_ > kMostElements)
      return refuse("more than " + std::to_string(kMostElements) + " elements");
    open_.emplace_back();
    XmlElement& element = open_.back();
    element.name = name;
    for (; *attributes; attributes += 2)
      element.attributes.emplace_back(attributes[0], attributes[1]);
    element.line = line();
    element.begin = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_.get()));
  }

  void
  finish()
  {
    if (left_out_ > 0) {
      --left_out_;
      return;
    }
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    element.end = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_.get())) +
                  static_cast<std::uint64_t>(XML_GetCurrentByteCount(parser_.get()));
    if (open_.empty())
      root_ = std::move(element);
    else
      open_.back().children.push_back(std::move(element));
  }

  const KeepsElement& keeps_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlElement> open_;
  XmlElement root_;
  std::size_t left_out_ = 0; ///< open levels that are not kept
  std::size_t count_ = 0;
  std::string reason_;
  std::exception_ptr failure_;
};

} // namespace

XmlElement
readXml(const std::filesystem::path& path,
        const XmlBytes& bytes,
        const KeepsElement& keeps)
{
  TreeBuilder builder(keeps);
  std::array<char, 65536> block{};
  for (bool is_last = false; !is_last;) {
    const std::size_t size = bytes(block.data(), block.size());
    is_last = size == 0;
    if (!builder.parse(block.data(), size, is_last))
      text::fail(
          path,
          "XML section: line " + std::to_string(builder.line()) + ": " +
              (builder.reason().empty() ? "is not well-formed XML" : builder.reason()));
  }
  return builder.take();
}

} // namespace pcl6d::sources
