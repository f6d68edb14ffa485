// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_method_h
#define moraine_scene_method_h

#include <moraine/assembly/term.h>
#include <moraine/basis/basis.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/points/bodies.h>
#include <moraine/points/point_fields.h>
#include <moraine/points/seeding.h>
#include <moraine/state/state.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  template <int dim>
  struct Method;

  /** Section `Method`: the three choices in which methods differ. */
  template <int dim>
  struct MethodParameters
  {
    std::string  method               = "auto";
    unsigned int degree               = 1;
    unsigned int points_per_direction = 2;
    std::string  point_layout         = "equally spaced";
    std::string  strain               = "small";
    std::string  mesh_after_step      = "default";
    std::string  point_weights        = "volumes";
    std::string  volumetric_strain    = "auto";
    double       aggregate_below      = 0.1;
    std::string  cut_cells            = "aggregation";
    double       ghost_factor         = 0.1;
    double       fictitious_stiffness = 0.;
    std::string  domain_update        = "corners";
    std::string  split_domains        = "auto";
    std::string  separation           = "stop";
    double       return_tolerance     = 0.;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** @throw InputError for keys that the method does not allow. */
    void
    check() const;

    /** The entry of methods() that is chosen, once Scene has resolved auto. */
    const Method<dim> &
    chosen() const;

    MeshAfterStep
    after_step() const;

    PointWeights
    weights() const
    {
      return point_weights == "volumes" ? PointWeights::volumes :
                                          PointWeights::fitted_to_cells;
    }

    /** Whether nodes of cut cells are held by a GhostTerm. */
    bool
    has_ghost_term() const
    {
      return cut_cells == "ghost";
    }

    /** Cells can have means of the volumetric strain. */
    bool
    can_average_volume() const
    {
      return chosen().can_average_volume && degree == 1;
    }

    /** Gauss points of finite elements. */
    unsigned int
    gauss_points_per_direction() const
    {
      return degree == 1 ? 2 : std::clamp(points_per_direction, 2u, 3u);
    }

    /** Whether they are too few for the gradients of all functions of a cell.
     */
    bool
    integrates_too_little() const
    {
      return degree == 2 && method == "finite element" &&
             gauss_points_per_direction() == 2;
    }

    bool
    averages_volume() const
    {
      return volumetric() != VolumetricStrain::pointwise;
    }

    /** Once Scene has chosen what is meant by auto. */
    VolumetricStrain
    volumetric() const
    {
      if (volumetric_strain == "cell mean")
        return VolumetricStrain::cell_mean;
      return volumetric_strain == "cell mean with shear" ?
               VolumetricStrain::cell_mean_with_shear :
               VolumetricStrain::pointwise;
    }

    /** Boxes keep their size at small strain. */
    DomainUpdate
    update_of_domains() const;

    bool
    splits_domains() const
    {
      return split_domains == "true" ||
             (split_domains == "auto" && strain == "finite" &&
              chosen().can_split_domains);
    }

    /** Whether points move through the mesh and nothing that is theirs grows
     * with the distance between them. */
    bool
    points_drift_apart(const bool have_domains) const
    {
      return strain == "finite" && after_step() == MeshAfterStep::reset &&
             (!have_domains || update_of_domains() == DomainUpdate::frozen);
    }

    StrainMeasure
    strain_measure() const
    {
      return strain == "finite" ? StrainMeasure::finite : StrainMeasure::small;
    }
  };

  /** One of the methods that a scene can choose from. */
  template <int dim>
  struct Method
  {
    /** What a basis is made of. */
    struct Ingredients
    {
      const MethodParameters<dim>  &parameters;
      const GridSpace<dim>         &space;
      const PointSet<dim>          &points;
      const std::vector<Body<dim>> &bodies;
    };

    std::string name;
    /** One sentence for the key 'Method'. */
    std::string text;
    /** Unless the scene says something else. */
    MeshAfterStep mesh_after_step;
    /** A value of 'Mesh after step' that is refused, and what is allowed. */
    std::string  refused_after_step;
    std::string  allowed_after_step;
    unsigned int largest_degree;
    bool         can_fit_weights;
    bool         can_average_volume;
    bool         can_split_domains;
    /** How cells are filled with points. */
    std::function<CellSeeder<dim>(const MethodParameters<dim> &)> make_seeder;
    /** Add what the basis stores with each point. */
    std::function<void(const MethodParameters<dim> &, PointFields &)>
      request_fields;
    std::function<std::unique_ptr<Basis<dim>>(const Ingredients &)> make_basis;
    /** Whether make_internal_force makes one, which no integrator evaluates in
     * the middle of a step. */
    bool has_own_internal_force = false;
    /** Whether points have strains by other functions than their own. */
    bool recovers_strains = false;
    /** Its own internal force; none for InternalForce. */
    std::function<std::unique_ptr<Term<dim>>(const GridSpace<dim> &,
                                             const PointSet<dim> &)>
      make_internal_force;
  };

  /** All methods. A new one is an entry here. */
  template <int dim>
  const std::vector<Method<dim>> &
  methods();
} // namespace moraine

#endif
