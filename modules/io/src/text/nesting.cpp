// SPDX-License-Identifier: BSD-3-Clause
#include "text/text_cursor.h"

#include <vector>

namespace pcl6d {

using io::TextCursor;

namespace {

using namespace std::string_view_literals;

/** \brief The open brackets of JSON. */
class JsonBrackets {
public:
  void
  open(char bracket, const TextCursor& text)
  {
    open_.push_back(bracket);
    text.requireShallow(open_.size());
    at_key_ = bracket == '{';
  }

  void
  close()
  {
    if (!open_.empty())
      open_.pop_back();
    at_key_ = false;
  }

  /** \brief Whatever is neither a bracket nor a comment. */
  void
  pass(char c)
  {
    if (c == ',')
      at_key_ = !open_.empty() && open_.back() == '{';
    else if (c == ':' || c == '"')
      at_key_ = false;
  }

  /** \return whether a string at this position is a key */
  bool
  atKey() const
  {
    return at_key_;
  }

private:
  std::vector<char> open_;
  bool at_key_ = false;
};

/** Skips the rest of a JSON string, with the closing quote. */
void
skipJsonText(TextCursor& text, bool is_plain_key)
{
  while (!text.atEnd()) {
    const char c = text.take();
    if (c == '"')
      return;
    if (c == '\\' && is_plain_key)
      text.fail("a key with a backslash cannot be read");
    if (c == '\\')
      text.take();
  }
}

/** Skips the rest of an element's tag; the name may hold almost any character, and quotes begin
 * a value only behind a '='. \return whether the element has no content */
bool
skipTag(TextCursor& text)
{
  text.skipTo(" \t\r\n/>?\0"sv);
  char before = '\0'; // the last character that is not blank
  while (!text.atEnd()) {
    const char c = text.take();
    if (c == '>')
      return before == '/';
    if ((c == '"' || c == '\'') && before == '=')
      text.skipPast({&c, 1});
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n')
      before = c;
  }
  return false;
}

/** Skips the text after "<!": not an element. */
void
skipDeclaration(TextCursor& text)
{
  if (text.takeWord("--"))
    return text.skipPast("-->");
  if (text.takeWord("[CDATA["))
    return text.skipPast("]]>");
  const bool has_brackets = text.takeWord("DOCTYPE ") || text.takeWord("DOCTYPE\n") ||
                            text.takeWord("DOCTYPE\r") || text.takeWord("DOCTYPE\t");
  for (std::size_t brackets = 0; !text.atEnd();) { // <!DOCTYPE svg [ ... ]>
    const char c = text.take();
    if (c == '[' && has_brackets)
      ++brackets;
    if (c == ']' && brackets > 0)
      --brackets;
    if (c == '>' && brackets == 0)
      return;
  }
}

} // namespace

void
checkJsonNesting(std::string_view content, const std::string& name, JsonKeys keys)
{
  TextCursor text(content, name);
  JsonBrackets brackets;
  while (!text.atEnd()) {
    const char c = text.take();
    if (c == '/' && text.peek() == '/')
      text.skipTo("\n\r\0"sv);
    else if (c == '/' && text.takeWord("*"))
      text.skipPast("*/");
    else if (c == '[' || c == '{')
      brackets.open(c, text);
    else if (c == ']' || c == '}')
      brackets.close();
    else {
      if (c == '"')
        skipJsonText(text, keys == JsonKeys::kPlain && brackets.atKey());
      brackets.pass(c);
    }
  }
}

void
checkXmlNesting(std::string_view content, const std::string& name)
{
  TextCursor text(content, name);
  std::size_t depth = 0;
  for (text.skipPast("<"); !text.atEnd(); text.skipPast("<")) {
    if (text.takeWord("!"))
      skipDeclaration(text);
    else if (text.takeWord("?"))
      text.skipPast("?>");
    else if (text.takeWord("/")) {
      depth -= depth > 0 ? 1 : 0;
      text.skipTo(">");
    }
    else {
      text.requireShallow(++depth);
      if (skipTag(text))
        --depth;
    }
  }
}

} // namespace pcl6d
