// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/mesh_sides.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const char *const key_text = "Side names";



    bool
    is_number(const std::string &text)
    {
      return !text.empty() && text.size() < 10 &&
             std::all_of(text.begin(), text.end(), [](const char c) {
               return c >= '0' && c <= '9';
             });
    }



    std::string
    list_of_ids(const std::set<types::boundary_id> &ids)
    {
      std::vector<std::string> words;
      for (const auto id : ids)
        words.push_back(std::to_string(id));
      return list_of(words);
    }
  } // namespace



  types::boundary_id
  MeshSides::id_of(const std::string &name, const std::string &place) const
  {
    std::vector<std::string> known;
    for (const auto &[side, id] : names)
      {
        if (side == name)
          return id;
        known.push_back(side);
      }
    if (is_number(name) && unnamed.count(std::stoul(name)) > 0)
      return std::stoul(name);
    for (const auto id : unnamed)
      known.push_back(std::to_string(id));
    throw InputError(place + ": found '" + name +
                     "', allowed: a side of the mesh (" + list_of(known) + ")");
  }



  MeshSides
  read_side_names(
    const std::string                                             &text,
    const std::set<types::boundary_id>                            &found,
    const std::vector<std::pair<std::string, types::boundary_id>> &of_mesh)
  {
    MeshSides sides;
    sides.unnamed = found;
    for (const std::string &entry : Utilities::split_string_list(text, ','))
      {
        const auto parts = Utilities::split_string_list(entry, ':');
        if (parts.size() != 2 || parts[0].empty() || is_number(parts[0]) ||
            !is_number(parts[1]))
          reject("Mesh", key_text, entry, "pairs 'name: number'");
        const types::boundary_id id = std::stoul(parts[1]);
        if (found.count(id) == 0)
          reject("Mesh",
                 key_text,
                 entry,
                 "numbers that the boundary of the mesh has (" +
                   list_of_ids(found) + ")");
        for (const auto &[name, other] : sides.names)
          if (name == parts[0] || other == id)
            reject("Mesh",
                   key_text,
                   text,
                   "each name and each number once; '" + name + ": " +
                     std::to_string(other) + "' and '" + entry + "' meet");
        sides.names.emplace_back(parts[0], id);
        sides.unnamed.erase(id);
      }
    for (const auto &[name, id] : of_mesh)
      if (sides.unnamed.count(id) > 0 &&
          std::none_of(sides.names.begin(),
                       sides.names.end(),
                       [&name = name](const auto &side) {
                         return side.first == name;
                       }))
        sides.names.emplace_back(name, id);
    return sides;
  }
} // namespace moraine
