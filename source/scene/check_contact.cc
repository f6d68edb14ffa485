// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/check_contact.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  check_contact(const std::string                   &name,
                const BoundaryParameters<dim>       &boundary,
                const std::vector<InputFile::Entry> &given)
  {
    const std::string section = "Boundaries/" + name;
    const bool        touches = boundary.constraint == "contact";
    for (const auto &entry : given)
      if (entry.section == section &&
          (touches ? contains({"Penetration limit",
                               "Held in a cell",
                               "Nitsche factor",
                               "Penalty factor"},
                              entry.key) :
                     ContactParameters::has(entry.key)))
        reject(entry,
               "nothing; key 'Constraint' is '" + boundary.constraint + "'");
    if (touches && boundary.enforcement.enforcement != "augmented Lagrangian")
      reject(section,
             "Enforcement",
             boundary.enforcement.enforcement,
             "augmented Lagrangian; key 'Constraint' is 'contact'");
    boundary.contact.law(section);
  }



  template void
  check_contact(const std::string &,
                const BoundaryParameters<2> &,
                const std::vector<InputFile::Entry> &);
  template void
  check_contact(const std::string &,
                const BoundaryParameters<3> &,
                const std::vector<InputFile::Entry> &);
} // namespace moraine
