// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/state.h>

#include <moraine/material/elastic_state.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The fields, all of which points must have. */
    template <int dim>
    StateFields<dim>
    find_fields(const PointSet<dim>                                &points,
                const StrainMeasure                                 measure,
                const std::vector<std::shared_ptr<const Material>> &materials)
    {
      PointFields            layout = points.fields();
      const StateFields<dim> fields(layout, measure, materials);
      AssertThrow(layout.n_values() == points.fields().n_values(),
                  ExcMessage("The points lack fields of the state."));
      return fields;
    }
  } // namespace



  template <int dim>
  State<dim>::State(GridSpace<dim>                              &space,
                    PointSet<dim>                               &points,
                    Basis<dim>                                  &basis,
                    std::vector<std::shared_ptr<const Material>> materials_,
                    const MeshAfterStep    mesh_after_step,
                    const StrainMeasure    measure,
                    const PointWeights     weights,
                    const VolumetricStrain volumetric)
    : space(space)
    , points(points)
    , basis(basis)
    , materials(std::move(materials_))
    , after_step(mesh_after_step)
    , measure(measure)
    , keeps_parts(measure == StrainMeasure::finite && basis.has_domains())
    , symmetric_tangents(
        std::all_of(materials.begin(),
                    materials.end(),
                    [](const auto &m) { return m->has_symmetric_tangent(); }))
    , fitted_weights(weights == PointWeights::fitted_to_cells ?
                       std::make_optional<FittedWeights<dim>>(points) :
                       std::nullopt)
    , cell_means(volumetric == VolumetricStrain::pointwise ?
                   std::nullopt :
                   std::make_optional<CellMeans<dim>>(
                     volumetric == VolumetricStrain::cell_mean_with_shear))
    , state_fields(find_fields(points, measure, materials))
    , recovery_field(points.fields().find(FieldNames<dim>::stress_of_recovery))
  {
    for (const auto &material : materials)
      densities.push_back(material->density());
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        double            *values = points.values(p);
        const unsigned int body   = points.body(p);
        const auto         internal =
          materials[body]->internal_at(point_in_space(points.position(p)));
        for (unsigned int v = 0; v < internal.size(); ++v)
          state_fields.internal[body][v].store(internal[v], values);
        if (measure == StrainMeasure::small)
          continue;
        state_fields.F.store(unit_symmetric_tensor<dim>(), values);
        state_fields.b.store(unit_symmetric_tensor<3>(), values);
        state_fields.v_0.store(points.volume(p), values);
      }
  }



  template <int dim>
  SymmetricTensor<2, 3>
  State<dim>::set_initial_stress(const unsigned int           p,
                                 const SymmetricTensor<2, 3> &stress)
  {
    const Material &material = *materials[points.body(p)];
    double         *values   = points.values(p);
    auto            internal = state_fields.internal_of(points.body(p), values);
    points.stress_field().store(stress, values);
    material.initialise(stress, /* vertical = */ dim - 1, internal.data());
    for (unsigned int v = 0; v < internal.size(); ++v)
      state_fields.internal[points.body(p)][v].store(internal[v], values);
    if (!material.is_isotropic())
      return stress_unstrained(material,
                               measure,
                               stress,
                               {internal.begin(), internal.end()});
    const Spectrum     principal = spectrum<dim>(stress);
    const ElasticState found =
      elastic_state(material,
                    principal.values,
                    {internal.begin(), internal.end()});
    if (measure == StrainMeasure::finite)
      {
        Tensor<1, 3> b;
        for (unsigned int A = 0; A < 3; ++A)
          b[A] = std::exp(2 * found.strain[A]);
        state_fields.b.store(principal.tensor(b), values);
      }
    return principal.tensor(found.stress);
  }



  template <int dim>
  void
  State<dim>::place_by_nodes(const std::vector<bool> &new_bodies)
  {
    if (after_step != MeshAfterStep::follow_material)
      return;
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        for (unsigned int i = 0; i < block.n_points; ++i)
          {
            const unsigned int p = block.points[i];
            if (!new_bodies[points.body(p)])
              continue;
            Point<dim>     x;
            Tensor<2, dim> back = unit_symmetric_tensor<dim>(); // dX/dx
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const unsigned int node = block.nodes[a];
                x += block.N(i)[a] * space.node_position(node);
                back -=
                  outer_product(space.node_move(node), block.grad_N(i)[a]);
              }
            points.set_position(p, x);
            points.set_volume(p, points.volume(p) / determinant(back));
            if (measure == StrainMeasure::finite)
              state_fields.v_0.store(points.volume(p), points.values(p));
          }
      }
  }



  template <int dim>
  double
  State<dim>::volume_ratio(const unsigned int p) const
  {
    if (measure == StrainMeasure::small)
      return 1.;
    const double *F = points.values(p) + state_fields.F.offset();
    if constexpr (dim == 2)
      return F[0] * F[3] - F[1] * F[2];
    else
      return F[0] * (F[4] * F[8] - F[5] * F[7]) -
             F[1] * (F[3] * F[8] - F[5] * F[6]) +
             F[2] * (F[3] * F[7] - F[4] * F[6]);
  }



  template <int dim>
  bool
  State<dim>::is_linear() const
  {
    return measure == StrainMeasure::small &&
           std::all_of(materials.begin(), materials.end(), [](const auto &m) {
             return m->is_linear();
           });
  }



  template <int dim>
  bool
  State<dim>::dissipates() const
  {
    return std::any_of(materials.begin(), materials.end(), [](const auto &m) {
      return m->dissipates();
    });
  }



  template <int dim>
  bool
  State<dim>::begin_step(
    const typename Aggregates<dim>::AskOfCell &holds_mean_in)
  {
    bool       changed = false;
    const bool moved   = first_step || after_step != MeshAfterStep::keep;
    if (first_step || after_step == MeshAfterStep::reset)
      {
        std::vector<unsigned char> active(
          space.mesh().triangulation().n_active_cells(), 0);
        basis.mark_cells(active);
        changed = space.set_active_cells(active);
        if (cell_aggregates)
          changed = tie_nodes(std::move(active), holds_mean_in) || changed;
        changed    = basis.batch_points() || changed;
        first_step = false;
        if (fitted_weights)
          factors = fitted_weights->factors(space, points);
      }
    if (cell_means && moved)
      cell_means->update(
        space,
        basis,
        [this](const auto &block, const unsigned int i) {
          return volume_in_cell(block, i);
        },
        cell_aggregates ? cell_aggregates->roots_of_cells() : RootsOfCells());
    reject();
    return Utilities::MPI::logical_or(changed, space.communicator());
  }



  template <int dim>
  bool
  State<dim>::tie_nodes(
    std::vector<unsigned char>                 active,
    const typename Aggregates<dim>::AskOfCell &holds_mean_in)
  {
    // Where cells go with their points, they are filled as at the start.
    const auto volume = [this](const unsigned int p) {
      return after_step == MeshAfterStep::reset ? points.volume(p) :
                                                  initial_volume(p);
    };
    return cell_aggregates->tie_nodes(
      space, points, volume, std::move(active), holds_mean_in);
  }



  template <int dim>
  double
  State<dim>::volume_in_cell(const StencilBlock<dim> &block,
                             const unsigned int       i) const
  {
    const unsigned int p = block.points[i];
    if (after_step != MeshAfterStep::follow_material ||
        measure == StrainMeasure::small)
      return integration_volume(p);
    // What the quadrature has there now: volumes of points changed by means.
    Tensor<2, dim> back = unit_symmetric_tensor<dim>(); // dX/dx
    for (unsigned int a = 0; a < block.n_nodes; ++a)
      back -=
        outer_product(space.node_move(block.nodes[a]), block.grad_N(i)[a]);
    return state_fields.v_0(points.values(p)) / determinant(back);
  }



  template <int dim>
  void
  State<dim>::evaluate(const unsigned int batch, StencilBlock<dim> &block) const
  {
    basis.evaluate(batch, block);
    if (cell_means)
      cell_means->attach(batch, block);
  }



  template <int dim>
  double
  State<dim>::mean_part(const unsigned int point, const LameConstants &C) const
  {
    if (!keeps_parts)
      return 1;
    const double K = C.lambda + 2 * C.mu / dim;
    const double q =
      deviator(points.stress_field()(points.values(point))).norm();
    const double own = 6 * q * std::min(1., q / C.mu) * std::sqrt(K / C.mu);
    return 1 - std::min(1., own / K);
  }



  template <int dim>
  void
  State<dim>::nodes_of_mean(const unsigned int         active_cell_index,
                            std::vector<unsigned int> &nodes) const
  {
    nodes.clear();
    std::vector<typename CellMeans<dim>::Part> parts;
    mean_of_cell(active_cell_index, parts);
    for (const auto &part : parts)
      nodes.insert(nodes.end(),
                   space.cell_nodes(part.cell),
                   space.cell_nodes(part.cell) + space.nodes_per_cell());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }



  template <int dim>
  void
  State<dim>::commit(const TrialPoints<dim> &trial_points,
                     const unsigned int      i,
                     const unsigned int      p)
  {
    double               *values = points.values(p);
    SymmetricTensor<2, 3> stress = trial_points.stress(i);
    if (measure == StrainMeasure::finite)
      {
        const Tensor<2, dim> dF = Physics::Elasticity::Kinematics::F(
          trial_points.increment_gradient(i));
        const Tensor<2, dim> F = dF * state_fields.F(values);
        state_fields.F.store(F, values);
        state_fields.b.store(trial_points.elastic_left_cauchy_green(i), values);
        stress /= determinant(F);
        points.set_volume(p, determinant(dF) * points.volume(p));
      }
    const auto &internal = state_fields.internal[points.body(p)];
    for (unsigned int v = 0; v < internal.size(); ++v)
      internal[v].store(trial_points.internal_variables(i)[v], values);
    points.stress_field().store(stress, values);
  }



  template <int dim>
  void
  State<dim>::commit_recovery(const TrialPoints<dim>      &trial_points,
                              const unsigned int           i,
                              const unsigned int           p,
                              const SymmetricTensor<2, 3> *own)
  {
    SymmetricTensor<2, 3> stress;
    if (own)
      stress = (trial_points.weight(i) * trial_points.stress(i) - *own) /
                 points.volume(p) +
               stress_of_recovery(p);
    recovery_field.store(stress, points.values(p));
  }



  template <int dim>
  struct State<dim>::Acceptance
  {
    StencilBlock<dim>           block;
    std::vector<Tensor<1, dim>> nodal; // increments of the block's nodes
    TrialPoints<dim>            trial_points;

    // Of all points: displacement increments, their gradients, and stress times
    // volume by the points' own functions, where recovery needs it.
    std::vector<Tensor<1, dim>>        moves;
    std::vector<Tensor<2, dim>>        gradients;
    std::vector<SymmetricTensor<2, 3>> own;
  };



  template <int dim>
  void
  State<dim>::gather(const Basis<dim>  &of,
                     const unsigned int batch,
                     Acceptance        &work) const
  {
    if (&of == &basis)
      evaluate(batch, work.block);
    else
      of.evaluate(batch, work.block);
    work.nodal.resize(work.block.n_nodes);
    for (unsigned int a = 0; a < work.block.n_nodes; ++a)
      work.nodal[a] = trial[work.block.nodes[a]];
  }



  template <int dim>
  void
  State<dim>::find_own_stresses(Acceptance &work) const
  {
    const StencilBlock<dim> &block        = work.block;
    TrialPoints<dim>        &trial_points = work.trial_points;
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        end = end_of_body(block, begin);
        trial_points.evaluate(*this, block, begin, end, work.nodal.data());
        for (unsigned int p = begin; p < end; ++p)
          work.own[block.points[p]] =
            trial_points.weight(p - begin) * trial_points.stress(p - begin);
      }
  }



  template <int dim>
  void
  State<dim>::commit_block(Acceptance &work, StepEnergies *energies)
  {
    const StencilBlock<dim> &block        = work.block;
    TrialPoints<dim>        &trial_points = work.trial_points;
    for (unsigned int begin = 0, end = 0; begin < block.n_points; begin = end)
      {
        end = end_of_body(block, begin);
        trial_points.evaluate(*this, block, begin, end, work.nodal.data());
        if (energies)
          trial_points.add_energies(*this, block, begin, *energies);
        for (unsigned int p = begin; p < end; ++p)
          {
            const unsigned int point = block.points[p];
            if (recovery_field.exists())
              commit_recovery(trial_points,
                              p - begin,
                              point,
                              work.own.empty() ? nullptr : &work.own[point]);
            commit(trial_points, p - begin, point);
            work.gradients[point] = trial_points.increment_gradient(p - begin);
          }
      }
  }



  template <int dim>
  void
  State<dim>::displace(Acceptance &work)
  {
    const StencilBlock<dim> &block = work.block;
    const auto              &u     = points.displacement_field();
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        Tensor<1, dim>    &du    = work.moves[point];
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          du += block.N(p)[a] * work.nodal[a];
        u.store(u(points.values(point)) + du, points.values(point));
      }
  }



  template <int dim>
  void
  State<dim>::accept(const std::function<void()> &move_mesh,
                     StepEnergies                *energies)
  {
    const Basis<dim> &of_strains = basis.strain_basis();
    Acceptance        work;
    work.moves.resize(points.n_local());
    work.gradients.resize(points.n_local());
    if (recovery_field.exists() && energies) // with inertia alone
      work.own.resize(points.n_local());
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        gather(basis, g, work);
        if (&of_strains == &basis)
          commit_block(work, energies);
        else if (!work.own.empty())
          find_own_stresses(work);
        displace(work);
      }
    if (&of_strains != &basis)
      for (unsigned int g = 0; g < of_strains.n_batches(); ++g)
        {
          gather(of_strains, g, work);
          commit_block(work, energies);
        }
    if (after_step == MeshAfterStep::keep)
      return;
    basis.move_domains(points, trial, work.gradients);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      points.set_position(p, points.position(p) + work.moves[p]);
    if (after_step == MeshAfterStep::follow_material)
      space.move_nodes(trial);
    else
      {
        if (move_mesh)
          move_mesh();
        basis.split_domains(points);
        points.find_cells();
      }
  }



  template <int dim>
  unsigned int
  State<dim>::end_of_body(const StencilBlock<dim> &block,
                          const unsigned int       begin) const
  {
    const unsigned int body = points.body(block.points[begin]);
    unsigned int       end  = begin + 1;
    while (end < block.n_points && points.body(block.points[end]) == body)
      ++end;
    return end;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  State<dim>::point_increments() const
  {
    std::vector<Tensor<1, dim>> increments(points.n_local());
    StencilBlock<dim>           block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            increments[block.points[p]] +=
              block.N(p)[a] * trial[block.nodes[a]];
      }
    return increments;
  }



  template class State<2>;
  template class State<3>;
} // namespace moraine
