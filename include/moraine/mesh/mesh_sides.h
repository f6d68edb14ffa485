// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_mesh_sides_h
#define moraine_mesh_mesh_sides_h

#include <deal.II/base/types.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** The sides of a mesh: boundary ids, and what users call them. */
  struct MeshSides
  {
    /** Names in the order in which messages list them. */
    std::vector<std::pair<std::string, dealii::types::boundary_id>> names;

    /** The ids that are called by their number. */
    std::set<dealii::types::boundary_id> unnamed;

    /**
     * The id of the side called @p name.
     * @throws InputError naming @p place and the sides there are.
     */
    dealii::types::boundary_id
    id_of(const std::string &name, const std::string &place) const;
  };

  /**
   * Read the text of key `Side names`, "hole: 1, outer: 2", for a mesh whose
   * boundary has the ids @p found. What the mesh itself calls its sides,
   * @p of_mesh, are names too, where the text gives neither name nor id; these
   * sides are called by their number as well.
   *
   * @throws InputError for a text of another form, a name or id given twice,
   * and an id the boundary does not have.
   */
  MeshSides
  read_side_names(
    const std::string                          &text,
    const std::set<dealii::types::boundary_id> &found,
    const std::vector<std::pair<std::string, dealii::types::boundary_id>>
      &of_mesh = {});
} // namespace moraine

#endif
