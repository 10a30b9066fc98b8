// SPDX-License-Identifier: BSD-3-Clause
#include "text/text_cursor.h"

#include <vector>

namespace pcl6d {

using io::TextCursor;

namespace {

bool
isYamlDigit(char c)
{
  return c >= '0' && c <= '9';
}

bool
isYamlLetter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/** \return whether a character cannot be part of a word: a line end or an unprintable character */
bool
isControl(char c)
{
  return static_cast<unsigned char>(c) < ' ';
}

/** \brief An open collection. */
struct YamlLevel {
  char kind = 0;          ///< '[' or '{'; of blocks '-' or ':'
  std::size_t column = 0; ///< of a block
};

/** \brief Follows the YAML that OpenCV's FileStorage reads, level by level and without
 * recursion. Unknown syntax is rejected: continuing would mean guessing the parser's behaviour. */
class YamlNesting {
public:
  YamlNesting(std::string_view text, const std::string& name) : text_(text, name) {}

  void
  check()
  {
    text_.takeWord("\xEF\xBB\xBF"); // the mark of UTF-8
    bool is_first = true;
    for (skipSpaces(); !text_.atEnd(); skipSpaces()) {
      if (text_.peek() == '%') {
        text_.skipTo("\n");
        continue;
      }
      need(text_.takeWord("---") || is_first);
      is_first = false;
      skipSpaces();
      if (!isAtDocumentEnd())
        takeDocument();
      skipSpaces();
      // OpenCV skips three arbitrary characters, and may then loop forever.
      need(text_.atEnd() || text_.takeWord("..."));
    }
  }

private:
  [[noreturn]] void
  refuse() const
  {
    text_.fail("no YAML that OpenCV reads");
  }

  void
  need(bool kept) const
  {
    if (!kept)
      refuse();
  }

  /** Moves to the next significant character, across comments and lines. */
  void
  skipSpaces()
  {
    for (;;) {
      text_.skip(" ");
      if (text_.peek() == '#')
        text_.skipTo("\n");
      if (text_.peek() == '\r' && text_.peek(1) == '\n')
        text_.take();
      if (text_.peek() != '\n')
        break;
      text_.take();
      line_start_ = text_.place();
    }
    need(text_.atEnd() || !isControl(text_.peek()));
  }

  bool
  isAtDocumentEnd() const
  {
    return text_.atEnd() ||
           (text_.peek() == '.' && text_.peek(1) == '.' && text_.peek(2) == '.');
  }

  std::size_t
  column() const
  {
    return text_.place() - line_start_;
  }

  bool
  isInFlow() const
  {
    return !levels_.empty() &&
           (levels_.back().kind == '[' || levels_.back().kind == '{');
  }

  void
  open(char kind)
  {
    levels_.push_back({kind, column()});
    text_.requireShallow(levels_.size());
  }

  /** Reads a collection with its content. */
  void
  takeDocument()
  {
    levels_.clear();
    bool is_value_next = true;
    do
      is_value_next = is_value_next ? takeValue() : goOn();
    while (is_value_next || !levels_.empty());
  }

  /** Takes a value, or the beginning of a collection. \return whether another value comes
   * next */
  bool
  takeValue()
  {
    skipSpaces();
    if (text_.takeWord("!!binary"))
      return skipRows();
    const bool is_text = takeTag();
    const char c = text_.peek();
    if (c == '"' || c == '\'')
      takeQuoted(text_.take());
    else if (is_text)
      skipPlain(isInFlow() ? ",]}" : "");
    else if (isNumber(c, text_.peek(1)))
      text_.skip("0123456789+-.abcdefxABCDEFXinNI");
    else if (c == '[' || c == '{')
      return openFlow(text_.take());
    else if (c == '-' && !isInFlow())
      return openBlock('-');
    else if (isInFlow())
      skipPlain(",]}");
    else
      return takeWordOrMap();
    return false;
  }

  static bool
  isNumber(char c, char next)
  {
    return isYamlDigit(c) ||
           ((c == '-' || c == '+') && (isYamlDigit(next) || next == '.')) ||
           (c == '.' && (isYamlDigit(next) || isYamlLetter(next)));
  }

  /** Reads a tag, e.g. !!opencv-matrix. \return whether the tag makes the value a string */
  bool
  takeTag()
  {
    if (text_.peek() != '!')
      return false;
    need(text_.peek(1) != '<'); // a verbatim tag
    const bool is_text = text_.takeWord("!str ");
    while (!isControl(text_.peek()) && text_.peek() != ' ')
      text_.take();
    skipSpaces();
    return is_text;
  }

  /** Reads rows of base64 text that begin in the same column. \return false: no value comes next */
  bool
  skipRows()
  {
    need(text_.takeWord(" |"));
    skipSpaces();
    for (const std::size_t first = column(); !text_.atEnd() && column() == first;) {
      text_.skipTo("\n");
      skipSpaces();
    }
    return false;
  }

  void
  takeQuoted(char quote)
  {
    for (;;) {
      const char c = text_.take();
      need(!isControl(c));
      if (c == quote && !(quote == '\'' && text_.peek() == '\''))
        return;
      if (c == quote) // '' is a quote
        text_.take();
      else if (c == '\\' && quote == '"') // OpenCV skips characters after a code
        need(text_.peek() != 'x' && !isYamlDigit(text_.peek()) &&
             !isControl(text_.take()));
    }
  }

  /** Skips a word up to one of the characters, or to the line end. */
  void
  skipPlain(std::string_view ends)
  {
    const std::size_t begin = text_.place();
    while (!isControl(text_.peek()) && ends.find(text_.peek()) == ends.npos)
      text_.take();
    need(text_.place() > begin);
  }

  bool
  openFlow(char bracket)
  {
    open(bracket);
    skipSpaces();
    if (takeClosing())
      return false;
    if (bracket == '{')
      takeKey();
    return true;
  }

  bool
  openBlock(char kind)
  {
    open(kind);
    text_.take(); // the dash, or the colon behind the first key
    return true;
  }

  /** Reads a word that ends with the line, or the first key of a block. */
  bool
  takeWordOrMap()
  {
    need(text_.peek() != '?' && text_.peek() != '|' && text_.peek() != '>');
    const std::size_t begin = column();
    skipPlain(":");
    if (text_.peek() != ':')
      return false;
    openBlock(':');
    levels_.back().column = begin;
    return true;
  }

  void
  takeKey()
  {
    need(text_.peek() != '-');
    skipPlain(":");
    need(text_.take() == ':');
  }

  /** \return whether the open flow collection was closed */
  bool
  takeClosing()
  {
    const char c = text_.peek();
    if (c != ']' && c != '}')
      return false;
    need(c == (levels_.back().kind == '[' ? ']' : '}'));
    text_.take();
    levels_.pop_back();
    return true;
  }

  /** Continues behind a value. \return whether another value follows */
  bool
  goOn()
  {
    skipSpaces();
    return isInFlow() ? goOnInFlow() : goOnInBlock();
  }

  bool
  goOnInFlow()
  {
    if (takeClosing())
      return false;
    need(text_.peek() == ',');
    text_.take();
    skipSpaces();
    if (levels_.back().kind == '{')
      takeKey();
    return true;
  }

  bool
  goOnInBlock()
  {
    const YamlLevel level = levels_.back();
    if (isAtDocumentEnd() || column() < level.column) {
      levels_.pop_back();
      return false;
    }
    need(column() == level.column);
    if (level.kind == ':')
      takeKey();
    else
      need(text_.take() == '-');
    return true;
  }

  TextCursor text_;
  std::vector<YamlLevel> levels_;
  std::size_t line_start_ = 0;
};

} // namespace

void
checkYamlNesting(std::string_view text, const std::string& name)
{
  YamlNesting(text, name).check();
}

} // namespace pcl6d
