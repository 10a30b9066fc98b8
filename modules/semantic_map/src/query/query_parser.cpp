// SPDX-License-Identifier: BSD-3-Clause
#include "query/query_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace pcl6d {
using namespace semantic_map;

namespace {
/** \return the number of UTF-8 characters before a byte */
std::size_t
charactersBefore(const std::string& text, std::size_t offset)
{
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
      }));
}

std::string
messageOf(const std::string& query, std::size_t offset, const std::string& problem)
{
  return "query: column " + std::to_string(charactersBefore(query, offset) + 1) + ": " +
         problem;
}

struct OperatorName {
  const char* name;
  QueryOperator op;
};

constexpr std::array<OperatorName, 6> kOperators{{{"<=", QueryOperator::kLessEqual},
                                                  {">=", QueryOperator::kGreaterEqual},
                                                  {"!=", QueryOperator::kNotEqual},
                                                  {"=", QueryOperator::kEqual},
                                                  {"<", QueryOperator::kLess},
                                                  {">", QueryOperator::kGreater}}};

bool
isSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool
endsWord(char c)
{
  return isSpace(c) || c == '=' || c == '!' || c == '<' || c == '>' || c == ',' ||
         c == '\'' || c == '"';
}

std::optional<double>
numberFrom(const std::string& text)
{
  double number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() ||
      !std::isfinite(number))
    return {};
  return number;
}

class Parser {
public:
  explicit Parser(const std::string& text) : text_(text) {}

  MapQuery
  parse()
  {
    MapQuery query;
    query.text = text_;
    query.subject = subject();
    skipSpace();
    while (place_ < text_.size()) {
      query.conditions.push_back(condition());
      skipSpace();
    }
    return query;
  }

private:
  [[noreturn]] void
  fail(std::size_t offset, const std::string& problem) const
  {
    throw QueryError(text_, offset, problem);
  }

  void
  skipSpace()
  {
    while (place_ < text_.size() && isSpace(text_[place_]))
      ++place_;
  }

  /** \return the text at an offset, for messages */
  std::string
  found(std::size_t offset) const
  {
    if (offset >= text_.size())
      return "the end";
    std::size_t end = offset;
    while (end < text_.size() && !endsWord(text_[end]))
      ++end;
    return "'" + text_.substr(offset, std::max<std::size_t>(end - offset, 1)) + "'";
  }

  std::string
  word()
  {
    skipSpace();
    const std::size_t begin = place_;
    while (place_ < text_.size() && !endsWord(text_[place_]))
      ++place_;
    return text_.substr(begin, place_ - begin);
  }

  std::string
  subject()
  {
    skipSpace();
    const std::size_t begin = place_;
    const std::string name = pluralOf(word());
    if (name.empty())
      fail(begin,
           "expected what to look for (" + subjectNames() + "), got " + found(begin));
    return name;
  }

  QueryCondition
  condition()
  {
    QueryCondition condition;
    condition.offset = place_;
    condition.key = word();
    if (condition.key == "not") {
      skipSpace();
      condition.negated = true;
      condition.offset = place_;
      condition.key = word();
    }
    if (condition.key.empty())
      fail(condition.offset,
           "expected a condition such as class=chair, got " + found(condition.offset));
    condition.op = comparison(condition.key);
    condition.values.push_back(value());
    for (skipSpace(); place_ < text_.size() && text_[place_] == ','; skipSpace()) {
      ++place_;
      condition.values.push_back(value());
    }
    return condition;
  }

  QueryOperator
  comparison(const std::string& key)
  {
    skipSpace();
    for (const auto& entry : kOperators) {
      const std::string name = entry.name;
      if (text_.compare(place_, name.size(), name) != 0)
        continue;
      place_ += name.size();
      return entry.op;
    }
    fail(place_,
         "expected = != < <= > or >= behind '" + key + "', got " + found(place_));
  }

  QueryValue
  value()
  {
    skipSpace();
    QueryValue value;
    value.offset = place_;
    if (place_ < text_.size() && (text_[place_] == '\'' || text_[place_] == '"')) {
      value.quoted = true;
      value.text = quotedText();
      return value;
    }
    value.text = word();
    if (value.text.empty())
      fail(value.offset,
           "expected a value (a number, word, 'text in quotes', or plane:1), got " +
               found(value.offset));
    value.number = numberFrom(value.text);
    value.entity = entityFromText(value.text);
    return value;
  }

  std::string
  quotedText()
  {
    const std::size_t begin = place_;
    const char quote = text_[place_++];
    std::string content;
    while (place_ < text_.size() && text_[place_] != quote) {
      if (text_[place_] == '\\' && place_ + 1 < text_.size())
        ++place_;
      content += text_[place_++];
    }
    if (place_ >= text_.size())
      fail(begin, std::string("expected a closing ") + quote + ", got the end");
    ++place_;
    return content;
  }

  const std::string& text_;
  std::size_t place_ = 0;
};
} // namespace

QueryError::QueryError(const std::string& query,
                       std::size_t offset,
                       const std::string& problem)
: BadArgument(messageOf(query, offset, problem))
, marked_(query + '\n' + std::string(charactersBefore(query, offset), ' ') + '^')
{}

MapQuery
parseQuery(const std::string& text)
{
  return Parser(text).parse();
}

} // namespace pcl6d
