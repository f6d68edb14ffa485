// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/scene/method.h>

#include <moraine/assembly/double_mapping.h>
#include <moraine/basis/composite_functions.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/patterns.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    CellSeeder<dim>
    gauss_points(const MethodParameters<dim> &parameters)
    {
      // Gradients of Q2 ask for 2; 3 serves the stiffness better, but in 3D the
      // fit of 64 moments takes a tenth of a second for each cut cell.
      constexpr unsigned int fitted_degree = dim == 2 ? 3 : 2;
      return CellSeeder<dim>(parameters.gauss_points_per_direction(),
                             PointLayout::gauss,
                             parameters.degree == 2 ? fitted_degree : 0);
    }



    template <int dim>
    CellSeeder<dim>
    material_points(const MethodParameters<dim> &parameters)
    {
      constexpr double bytes_per_sub_cell = (1 + 3 * dim) * sizeof(double);
      require_memory(bytes_per_sub_cell *
                       std::pow(1. * parameters.points_per_direction, dim),
                     place("Method", "Points per direction") + ": found " +
                       std::to_string(parameters.points_per_direction) +
                       " points");
      return CellSeeder<dim>(parameters.points_per_direction,
                             parameters.point_layout == "Gauss" ?
                               PointLayout::gauss :
                               PointLayout::equal);
    }



    template <int dim>
    std::unique_ptr<Basis<dim>>
    cell_basis(const typename Method<dim>::Ingredients &of)
    {
      if (of.parameters.degree == 1)
        return std::make_unique<CellBasis<dim, 1>>(of.space, of.points);
      return std::make_unique<CellBasis<dim, 2>>(of.space, of.points);
    }



    const auto no_own_internal_force = [](const auto &, const auto &) {
      return nullptr;
    };



    template <int dim>
    Method<dim>
    finite_element()
    {
      Method<dim> method;
      method.name                = "finite element";
      method.text                = "Gauss points that stay in their cell.";
      method.mesh_after_step     = MeshAfterStep::follow_material;
      method.refused_after_step  = "reset";
      method.allowed_after_step  = "follow material or keep with finite "
                                   "elements, whose points stay in their cells";
      method.largest_degree      = 2;
      method.can_fit_weights     = false;
      method.can_average_volume  = true;
      method.can_split_domains   = false;
      method.make_seeder         = gauss_points<dim>;
      method.request_fields      = [](const auto &, PointFields &) {};
      method.make_basis          = cell_basis<dim>;
      method.make_internal_force = no_own_internal_force;
      return method;
    }



    template <int dim>
    Method<dim>
    material_point()
    {
      Method<dim> method;
      method.name                = "material point";
      method.text                = "points that move through the mesh.";
      method.mesh_after_step     = MeshAfterStep::reset;
      method.largest_degree      = 1;
      method.can_fit_weights     = true;
      method.can_average_volume  = true;
      method.can_split_domains   = false;
      method.make_seeder         = material_points<dim>;
      method.request_fields      = [](const auto &, PointFields &) {};
      method.make_basis          = cell_basis<dim>;
      method.make_internal_force = no_own_internal_force;
      return method;
    }



    /** What all methods share whose points have domains. */
    template <int dim>
    Method<dim>
    with_domains(const std::string &name, const std::string &text)
    {
      Method<dim> method        = material_point<dim>();
      method.name               = name;
      method.text               = text;
      method.can_fit_weights    = false;
      method.refused_after_step = "follow material";
      method.allowed_after_step = "reset or keep with method '" + name + "'";
      return method;
    }



    /** GIMP's basis, or one derived from it. */
    template <int dim, class BoxBasis>
    std::unique_ptr<Basis<dim>>
    box_basis(const typename Method<dim>::Ingredients &of)
    {
      std::vector<bool>           is_seeded;
      std::vector<Tensor<2, dim>> half_edges;
      for (const Body<dim> &body : of.bodies)
        {
          is_seeded.push_back(body.shape != nullptr);
          half_edges.push_back(body.listed.half_edges);
        }
      return std::make_unique<BoxBasis>(of.space,
                                        of.points,
                                        material_points<dim>(of.parameters),
                                        is_seeded,
                                        of.parameters.update_of_domains(),
                                        of.parameters.splits_domains(),
                                        of.parameters.method,
                                        half_edges);
    }



    template <int dim>
    Method<dim>
    gimp()
    {
      Method<dim> method =
        with_domains<dim>("GIMP",
                          "the same, averaged over the box of each point; "
                          "needs a box of equal cells.");
      method.can_split_domains = true;
      method.request_fields = [](const auto &parameters, PointFields &fields) {
        GimpBasis<dim>::request_fields(fields, parameters.update_of_domains());
      };
      method.make_basis = [](const auto &of) {
        return box_basis<dim, GimpBasis<dim>>(of);
      };
      return method;
    }



    template <int dim>
    Method<dim>
    cpdi1()
    {
      Method<dim> method =
        with_domains<dim>("CPDI1",
                          "averaged over a parallelogram (in 3D a "
                          "parallelepiped) that is carried along with the "
                          "point; on any mesh.");
      method.can_split_domains = true;
      method.request_fields    = [](const auto &, PointFields &fields) {
        Cpdi1Basis<dim>::request_fields(fields);
      };
      method.make_basis = [](const auto &of) {
        return std::make_unique<Cpdi1Basis<dim>>(
          of.space,
          of.points,
          material_points<dim>(of.parameters),
          of.bodies,
          of.parameters.splits_domains(),
          of.parameters.averages_volume(),
          of.parameters.method);
      };
      return method;
    }



    template <int dim>
    Method<dim>
    cpdi2()
    {
      Method<dim> method =
        with_domains<dim>("CPDI2",
                          "the same over a quadrilateral (in 3D a hexahedron) "
                          "whose corners are carried along.");
      method.can_split_domains = true;
      method.request_fields    = [](const auto &, PointFields &fields) {
        Cpdi2Basis<dim>::request_fields(fields);
      };
      method.make_basis = [](const auto &of) {
        return std::make_unique<Cpdi2Basis<dim>>(
          of.space,
          of.points,
          material_points<dim>(of.parameters),
          of.bodies,
          of.parameters.splits_domains(),
          of.parameters.averages_volume(),
          of.parameters.method);
      };
      return method;
    }



    /** @p of with the stiffness integrated over Gauss points. */
    template <int dim>
    Method<dim>
    double_mapping(Method<dim>        of,
                   const std::string &name,
                   const std::string &text)
    {
      of.name                   = name;
      of.text                   = text;
      of.allowed_after_step     = "reset or keep with method '" + name + "'";
      of.has_own_internal_force = true;
      of.can_average_volume     = false;
      of.make_internal_force = [name](const auto &space, const auto &points) {
        return std::make_unique<DoubleMapping<dim>>(space, points, name);
      };
      return of;
    }



    /** Without domains. */
    template <int dim, class PointBasis>
    Method<dim>
    double_mapping_of_points(const std::string &name, const std::string &text)
    {
      Method<dim> method =
        double_mapping(with_domains<dim>(name, text), name, text);
      method.make_basis = [](const auto &of) {
        require_box_mesh(of.space, of.parameters.method);
        return std::make_unique<PointBasis>(of.space, of.points);
      };
      return method;
    }



    template <int dim>
    Method<dim>
    dm_c()
    {
      Method<dim> method = double_mapping_of_points<
        dim,
        WithCompositeStrain<dim, CellBasis<dim, 1>>>(
        "DM-C",
        "DM with the strain of points from composite functions of the cells around.");
      method.recovers_strains = true;
      return method;
    }



    template <int dim>
    Method<dim>
    dm_gc()
    {
      Method<dim> method =
        double_mapping(gimp<dim>(), "DM-GC", "DM-G and DM-C together.");
      method.make_basis = [](const auto &of) {
        return box_basis<dim, WithCompositeStrain<dim, GimpBasis<dim>>>(of);
      };
      method.recovers_strains = true;
      return method;
    }



    /** The names of those methods for which @p holds, in words. */
    template <int dim, class Condition>
    std::string
    names_where(const Condition &holds, const std::string &quote)
    {
      std::string names;
      for (const Method<dim> &method : methods<dim>())
        if (holds(method))
          names += (names.empty() ? "" : " and ") + quote + method.name + quote;
      return names;
    }
  } // namespace



  template <int dim>
  const std::vector<Method<dim>> &
  methods()
  {
    static const std::vector<Method<dim>> all{
      finite_element<dim>(),
      material_point<dim>(),
      gimp<dim>(),
      cpdi1<dim>(),
      cpdi2<dim>(),
      double_mapping_of_points<dim, CellBasis<dim, 1>>(
        "DM",
        "double mapping: points whose stiffness is that of the Gauss points of each cell, to which it is mapped through the nodes; on a box of equal cells, as the next three."),
      double_mapping(gimp<dim>(),
                     "DM-G",
                     "the same by the local functions of GIMP."),
      dm_c<dim>(),
      dm_gc<dim>()};
    return all;
  }



  template <int dim>
  void
  MethodParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    std::vector<std::string> names{"auto"};
    std::string              texts =
      "auto: GIMP on a mesh of type 'box' without 'Mesh motion', CPDI1 on "
      "others.";
    for (const Method<dim> &one : methods<dim>())
      {
        names.push_back(one.name);
        texts += " " + one.name + ": " + one.text;
      }
    prm.add_parameter("Method", method, texts, patterns::selection(names));
    prm.add_parameter("Degree",
                      degree,
                      "Degree of the shape functions, 1 or 2; 2 with finite "
                      "elements only.",
                      patterns::integer_in_range(1, 2));
    prm.add_parameter("Points per direction",
                      points_per_direction,
                      "Points a full cell gets in each direction. Finite "
                      "elements of degree 1 have 2; of degree 2 they have 3, "
                      "or 2 (reduced integration) if that is given or, without "
                      "this key, if a material yields.",
                      patterns::integer_in_range(1, 1000));
    prm.add_parameter("Point layout",
                      point_layout,
                      "Where the points of a full cell are. Finite elements "
                      "always use Gauss points.",
                      patterns::selection({"equally spaced", "Gauss"}));
    prm.add_parameter(
      "Strain",
      strain,
      "small: strains and rotations are small, in a step and in the whole run "
      "(diagnostic small-strain). "
      "finite: updated Lagrangian, logarithmic strain; any deformation.",
      patterns::selection({"small", "finite"}));
    prm.add_parameter(
      "Mesh after step",
      mesh_after_step,
      "reset: points move and the mesh stays. follow material: nodes move with "
      "the material. keep: nothing moves (small displacement). default: follow "
      "material with finite elements, reset otherwise.",
      patterns::selection({"default", "reset", "follow material", "keep"}));
    prm.add_parameter(
      "Point weights",
      point_weights,
      "Of method 'material point' with mesh after step 'reset': over what "
      "the stress of a point is integrated. volumes: its own. fitted to cells: "
      "in cells with points all around, volumes times factors by which the "
      "points of the cell integrate linear functions exactly, wherever they "
      "have moved. Best with 3 or more points per direction.",
      patterns::selection({"volumes", "fitted to cells"}));
    prm.add_parameter(
      "Volumetric strain",
      volumetric_strain,
      "What changes the volume of points. pointwise: the strain of each; cells "
      "lock, far too stiff, where the material hardly changes its volume (a "
      "Poisson ratio near 0.5, plastic flow). cell mean: the mean over the "
      "cell, by volume (B-bar, with finite strain F-bar), of which a box has "
      "its share in each cell. cell mean with shear: four fifths of all other "
      "strain, too, is the mean over the cell, so that soil flows which dilates "
      "as it is sheared; not where nodes of cut cells are tied. auto: the last if a material has friction, unless points "
      "move through the mesh at finite strain; else cell mean if a material yields or has a "
      "Poisson ratio above 0.4, but not with 'Degree = 2', methods of double "
      "mapping, the integrator 'energy-momentum' and stiffness damping, which "
      "cannot have it; pointwise otherwise.",
      patterns::selection(
        {"auto", "pointwise", "cell mean", "cell mean with shear"}));
    prm.add_parameter(
      "Domain update",
      domain_update,
      "Of methods with boxes at finite strain, how the box of a point changes. frozen: not. "
      "stretch: by the diagonal of the stretch U. corners: its corners move "
      "with the mesh and the volume is corrected.",
      patterns::selection({"frozen", "stretch", "corners"}));
    prm.add_parameter(
      "Split domains",
      split_domains,
      "Of methods whose points have domains: halve points whose domain grows "
      "longer than 3/4 of a cell, so that they stay together however far they "
      "are stretched. false: bodies may tear where domains grow as long as "
      "cells; boxes of GIMP beyond the cells that touch the point's end the "
      "run. auto: at finite strain, unless the scene has a force on points.",
      patterns::selection({"auto", "true", "false"}));
    prm.add_parameter(
      "Separation",
      separation,
      "When a body falls into more parts than it had because its points "
      "drifted so far apart that they share no node, and carry no force across "
      "(numerical fracture). stop: end the run with the place. note: say so "
      "once and go on, for bodies that are meant to come apart.",
      patterns::selection({"stop", "note"}));
    prm.add_parameter(
      "Return tolerance",
      return_tolerance,
      "Points that end outside the mesh, but by no more than this many cell "
      "sizes, are returned to its edge, and the run says so. 0: a point "
      "outside ends the run. For coarse meshes that turn with a curved wall.",
      patterns::non_negative());
    prm.add_parameter(
      "Aggregate below",
      aggregate_below,
      "Nodes only of cells of which points fill less than this part follow the "
      "functions of the nearest cell that they fill more of, so that small "
      "cuts are not felt (aggregation). 0: they are free. With more, at most "
      "0.5, bodies that bend far need fewer iterations; coarse meshes get "
      "less exact. If not 0 it is at least 0.5 in the cells that multipliers of "
      "implicit boundaries hold the means of, and in those that touch them, "
      "where points move through cells at finite strain.",
      Patterns::Double(0., 1.));
    prm.add_parameter(
      "Cut cells",
      cut_cells,
      "How nodes only of such cells follow. aggregation: exactly. ghost: they "
      "are held to it by springs that resist the increment of a step and then "
      "are forgotten.",
      patterns::selection({"aggregation", "ghost"}));
    prm.add_parameter(
      "Ghost factor",
      ghost_factor,
      "Stiffness of these springs over shear modulus times cell size (in 2D "
      "times the thickness 1), and in dynamics their mass over that of a full "
      "cell. Less holds nodes less; more is as aggregation, but multigrid "
      "takes more iterations.",
      patterns::positive());
    prm.add_parameter(
      "Fictitious stiffness",
      fictitious_stiffness,
      "Stiffness of the part of cells that points leave empty, as a fraction "
      "of the material's. It acts on the increment of a step and holds nodes "
      "that too few points touch. 0: none, until a matrix is singular, "
      "multigrid fails where a shorter step has the same matrix, or a step is "
      "rejected twice in a row; then the first that is enough of 1e-10, 1e-8, "
      "1e-6 and 1e-4 from that step on, and the run says so.",
      patterns::non_negative());
  }



  template <int dim>
  const Method<dim> &
  MethodParameters<dim>::chosen() const
  {
    const auto &all = methods<dim>();
    const auto  one = std::find_if(all.begin(), all.end(), [this](auto &m) {
      return m.name == method;
    });
    AssertThrow(one != all.end(), ExcInternalError());
    return *one;
  }



  template <int dim>
  MeshAfterStep
  MethodParameters<dim>::after_step() const
  {
    if (mesh_after_step == "keep")
      return MeshAfterStep::keep;
    if (mesh_after_step == "follow material")
      return MeshAfterStep::follow_material;
    if (mesh_after_step == "reset")
      return MeshAfterStep::reset;
    return chosen().mesh_after_step;
  }



  template <int dim>
  DomainUpdate
  MethodParameters<dim>::update_of_domains() const
  {
    if (strain == "small" || domain_update == "frozen")
      return DomainUpdate::frozen;
    return domain_update == "stretch" ? DomainUpdate::stretch :
                                        DomainUpdate::corners;
  }



  template <int dim>
  void
  MethodParameters<dim>::check() const
  {
    const Method<dim> &kind = chosen();
    if (degree > kind.largest_degree)
      reject("Method",
             "Degree",
             std::to_string(degree),
             "1 with method '" + method + "'; 2 with " +
               names_where<dim>(
                 [](const auto &m) { return m.largest_degree > 1; }, "'"));
    if (mesh_after_step == kind.refused_after_step)
      reject("Method",
             "Mesh after step",
             mesh_after_step,
             kind.allowed_after_step);
    if (strain == "finite" && mesh_after_step == "keep")
      reject("Method",
             "Mesh after step",
             mesh_after_step,
             "reset or follow material with finite strain");
    if (weights() != PointWeights::volumes &&
        !(kind.can_fit_weights && after_step() == MeshAfterStep::reset))
      reject("Method",
             "Point weights",
             point_weights,
             "volumes with method '" + method + "' and mesh after step '" +
               mesh_after_step + "'; " +
               names_where<dim>([](const auto &m) { return m.can_fit_weights; },
                                "") +
               " with 'reset' fits");
    if (has_ghost_term() && aggregate_below == 0)
      reject("Method",
             "Cut cells",
             cut_cells,
             "aggregation with 'Aggregate below = 0', by which no node is "
             "held");
    if (averages_volume() && !can_average_volume())
      reject("Method",
             "Volumetric strain",
             volumetric_strain,
             "pointwise with method '" + method + "' and degree " +
               std::to_string(degree) + "; " +
               names_where<dim>(
                 [](const auto &m) { return m.can_average_volume; }, "") +
               " of degree 1 average");
    if (split_domains == "true" && !kind.can_split_domains)
      reject("Method",
             "Split domains",
             "true",
             "false with method '" + method + "'; " +
               names_where<dim>(
                 [](const auto &m) { return m.can_split_domains; }, "") +
               " split");
  }



  template struct MethodParameters<2>;
  template struct MethodParameters<3>;
  template const std::vector<Method<2>> &
  methods<2>();
  template const std::vector<Method<3>> &
  methods<3>();
} // namespace moraine
