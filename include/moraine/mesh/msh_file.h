// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_msh_file_h
#define moraine_mesh_msh_file_h

#include <istream>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /**
   * What is wrong with a file of gmsh in format 2 or 4 as text, or "" if it is
   * complete: all its sections end, nodes and elements are as many as it says,
   * and elements have nodes that exist. deal.II's reader takes this for granted
   * and writes to memory it does not own if it is not so.
   *
   * Source: gmsh reference manual 4.8, "MSH file format" and "Legacy formats".
   */
  std::string
  complaint_about_msh(std::istream &in);

  /** Names and numbers of the physical groups of dimension @p dimension, of
   * section $PhysicalNames; none if the file has no such section. */
  std::vector<std::pair<std::string, unsigned int>>
  physical_names_of_msh(std::istream &in, const unsigned int dimension);
} // namespace moraine

#endif
