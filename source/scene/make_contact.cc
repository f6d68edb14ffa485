// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/scene_conditions.h>

#include <moraine/core/exceptions.h>
#include <moraine/scene/scene_bodies.h>
#include <moraine/scene/surface_motion.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::vector<ContactBoundary<dim>>
  make_contact_boundaries(const Scene<dim>                            &scene,
                          const typename ContactBoundary<dim>::Finder &find_rim)
  {
    const NamedShapes<dim>            shapes = body_shapes(scene);
    std::vector<ContactBoundary<dim>> boundaries;
    for (const auto &[name, parameters] : scene.boundaries)
      if (parameters.constraint == "contact")
        {
          const std::string section = "Boundaries/" + name;
          boundaries.emplace_back(name,
                                  make_surface<dim>(parameters.surface,
                                                    shapes,
                                                    section),
                                  motion_of_surface(name, parameters, scene),
                                  find_rim,
                                  parameters.contact.law(section),
                                  parameters.enforcement.enforcement_of());
        }
    return boundaries;
  }



  template std::vector<ContactBoundary<2>>
  make_contact_boundaries(const Scene<2> &, const ContactBoundary<2>::Finder &);
  template std::vector<ContactBoundary<3>>
  make_contact_boundaries(const Scene<3> &, const ContactBoundary<3>::Finder &);
} // namespace moraine
