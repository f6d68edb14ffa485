// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/located.h>

#include <moraine/core/object_error.h>

#include <map>

namespace moraine
{
  namespace
  {
    /** Section, and where known key, that an object comes from. */
    std::string
    origin_of(const ObjectError &error)
    {
      const std::map<std::string, std::string> sections{
        {"load", "section 'Loads/" + error.name + "'"},
        {"force on points", place("Loads/" + error.name, "Location")},
        {"body", "section 'Bodies/" + error.name + "'"},
        {"point file", place("Bodies/" + error.name, "Point file")},
        {"points", place("Method", "Points per direction")},
        {"bodies", "section 'Bodies'"},
        {"grid conditions", "section 'Grid conditions'"},
        {"method", place("Method", "Method")}};
      return sections.at(error.kind);
    }
  } // namespace



  std::string
  located(const InputFile &input, const InputError &error)
  {
    const auto *of_object = dynamic_cast<const ObjectError *>(&error);
    return input.located(of_object == nullptr ?
                           error.what() :
                           origin_of(*of_object) + ": " + of_object->text);
  }
} // namespace moraine
