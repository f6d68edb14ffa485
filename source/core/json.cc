// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/json.h>

#include <moraine/core/atomic_file.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace moraine
{
  namespace
  {
    void
    write_number(std::ostream &out, const double value)
    {
      if (!std::isfinite(value))
        {
          out << "null";
          return;
        }
      char       text[32];
      const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
      out.write(text, end - text);
    }



    void
    write_text(std::ostream &out, const std::string &text)
    {
      out << '"';
      for (const char c : text)
        if (c == '"' || c == '\\')
          out << '\\' << c;
        else if (c == '\n')
          out << "\\n";
        else if (static_cast<unsigned char>(c) < 0x20)
          {
            char escaped[8];
            std::snprintf(escaped, sizeof(escaped), "\\u%04x", c);
            out << escaped;
          }
        else
          out << c;
      out << '"';
    }
  } // namespace



  Json::Json(const bool value)
    : content(value)
  {}



  Json::Json(const double value)
    : content(value)
  {}



  Json::Json(const std::string &value)
    : content(value)
  {}



  Json::Json(const char *value)
    : content(std::string(value))
  {}



  Json
  Json::array()
  {
    Json value;
    value.content = Array();
    return value;
  }



  Json
  Json::object()
  {
    Json value;
    value.content = Object();
    return value;
  }



  Json &
  Json::operator[](const std::string &name)
  {
    if (std::holds_alternative<std::monostate>(content))
      content = Object();
    Assert(std::holds_alternative<Object>(content),
           dealii::ExcMessage("Not an object."));
    auto &members = std::get<Object>(content);
    for (auto &member : members)
      if (member.first == name)
        return member.second;
    members.emplace_back(name, Json());
    return members.back().second;
  }



  void
  Json::push_back(const Json &value)
  {
    if (std::holds_alternative<std::monostate>(content))
      content = Array();
    Assert(std::holds_alternative<Array>(content),
           dealii::ExcMessage("Not an array."));
    std::get<Array>(content).push_back(value);
  }



  void
  Json::write(std::ostream &out) const
  {
    write(out, 0);
    out << '\n';
  }



  void
  Json::save(const std::string &path) const
  {
    AtomicFile file(path);
    write(file.stream());
    file.commit();
  }



  void
  Json::write(std::ostream &out, const unsigned int indent) const
  {
    if (const auto *flag = std::get_if<bool>(&content))
      out << (*flag ? "true" : "false");
    else if (const auto *integer = std::get_if<std::int64_t>(&content))
      out << std::to_string(*integer);
    else if (const auto *number = std::get_if<double>(&content))
      write_number(out, *number);
    else if (const auto *text = std::get_if<std::string>(&content))
      write_text(out, *text);
    else if (std::holds_alternative<Array>(content))
      write_array(out, indent);
    else if (std::holds_alternative<Object>(content))
      write_object(out, indent);
    else
      out << "null";
  }



  void
  Json::write_array(std::ostream &out, const unsigned int indent) const
  {
    const auto &values = std::get<Array>(content);
    const bool  plain =
      std::none_of(values.begin(), values.end(), [](const Json &value) {
        return std::holds_alternative<Array>(value.content) ||
               std::holds_alternative<Object>(value.content);
      });
    const std::string line = "\n" + std::string(indent + 2, ' ');
    out << '[';
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        out << (i == 0 ? "" : plain ? ", " : ",") << (plain ? "" : line);
        values[i].write(out, indent + 2);
      }
    out << (plain ? "" : "\n" + std::string(indent, ' ')) << ']';
  }



  void
  Json::write_object(std::ostream &out, const unsigned int indent) const
  {
    const auto &members = std::get<Object>(content);
    out << '{';
    for (std::size_t i = 0; i < members.size(); ++i)
      {
        out << (i == 0 ? "\n" : ",\n") << std::string(indent + 2, ' ');
        write_text(out, members[i].first);
        out << ": ";
        members[i].second.write(out, indent + 2);
      }
    out << (members.empty() ? "" : "\n" + std::string(indent, ' ')) << '}';
  }
} // namespace moraine
