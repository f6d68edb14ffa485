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
  check_contact(const Scene<dim>                    &scene,
                const std::string                   &name,
                const BoundaryParameters<dim>       &boundary,
                const std::vector<InputFile::Entry> &given)
  {
    const std::string  section  = "Boundaries/" + name;
    const bool         touches  = boundary.constraint == "contact";
    const std::string &how      = boundary.enforcement.enforcement;
    const bool         has_flux = how == "incomplete Nitsche";
    for (const auto &entry : given)
      if (entry.section == section &&
          (touches ?
             contains({"Penetration limit", "Held in a cell", "Penalty factor"},
                      entry.key) :
             ContactParameters::has(entry.key)))
        reject(entry,
               "nothing; key 'Constraint' is '" + boundary.constraint + "'");
      else if (entry.section == section && touches &&
               entry.key == (has_flux ? "Band width" : "Nitsche factor"))
        reject(entry, "nothing; key 'Enforcement' is '" + how + "'");
    if (touches && !has_flux && how != "augmented Lagrangian")
      reject(section,
             "Enforcement",
             how,
             "augmented Lagrangian, incomplete Nitsche; key 'Constraint' is "
             "'contact'");
    if (!touches && has_flux)
      reject(section,
             "Enforcement",
             how,
             "skew or symmetric Nitsche; key 'Constraint' is '" +
               boundary.constraint + "'");
    if (touches && has_flux &&
        (scene.is_dynamic() ||
         scene.method.strain_measure() != StrainMeasure::small))
      reject(section,
             "Enforcement",
             how,
             "augmented Lagrangian in dynamics and at finite strain");
    boundary.contact.law(section);
  }



  template void
  check_contact(const Scene<2> &,
                const std::string &,
                const BoundaryParameters<2> &,
                const std::vector<InputFile::Entry> &);
  template void
  check_contact(const Scene<3> &,
                const std::string &,
                const BoundaryParameters<3> &,
                const std::vector<InputFile::Entry> &);
} // namespace moraine
