// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mechanics_system.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  MechanicsSystem<dim>::MechanicsSystem(
    State<dim>                            &state,
    std::vector<ImplicitBoundary<dim>>    &boundaries,
    const std::vector<GridCondition<dim>> &conditions,
    Loads<dim>                            &loads,
    const std::vector<std::string>        &body_names,
    const double                           empty_stiffness,
    TimerOutput                           *timer)
    : state(state)
    , boundaries(boundaries)
    , conditions(conditions)
    , loads(loads)
    , body_names(body_names)
    , unused_timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , timer(timer ? *timer : unused_timer)
    , empty_stiffness(empty_stiffness)
  {
    point_terms.push_back(std::make_unique<InternalForce<dim>>());
  }



  template <int dim>
  double
  MechanicsSystem<dim>::point_size() const
  {
    double               volume = 0;
    const PointSet<dim> &points = state.material_points();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      volume = std::max(volume, points.volume(p));
    return std::pow(Utilities::MPI::max(volume, state.grid().communicator()),
                    1. / dim);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::move_mesh_by(const MeshMotion<dim> &motion,
                                     BackgroundMesh<dim>   &mesh)
  {
    mesh_motion = motion;
    moving_mesh = &mesh;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::begin_step(
    const double                 t,
    const std::function<void()> &before_new_tangent)
  {
    {
      TimerOutput::Scope scope(timer, "stencils");
      changed = state.begin_step();
    }
    // Nodes may move into or out of the boxes of conditions.
    changed = changed || (mesh_motion.moves() &&
                          std::any_of(conditions.begin(),
                                      conditions.end(),
                                      [](const auto &condition) {
                                        return condition.region.has_value();
                                      }));
    t_start = t;
    if (!boundaries.empty() || !loads.carried.empty())
      reach = point_size();
    const bool cells_moved =
      changed || mesh_motion.moves() ||
      state.mesh_after_step() == MeshAfterStep::follow_material;
    {
      TimerOutput::Scope scope(timer, "boundary pieces");
      for (auto &boundary : boundaries)
        boundary.begin_step(state.grid(),
                            t,
                            reach,
                            state.mesh_after_step() != MeshAfterStep::keep,
                            state.strain_measure(),
                            cells_moved);
    }
    // On a mesh that does not reset, places stay in their cells.
    if (changed || state.mesh_after_step() == MeshAfterStep::reset)
      for (auto &load : loads.carried)
        load.find_cells(state.grid(), reach);
    for (auto &load : loads.on_points)
      load.find_points(state.material_points());
    if (changed && before_new_tangent)
      before_new_tangent();
    if (changed)
      set_up_unknowns();
    else if (cells_moved)
      make_rigid_modes();
    find_empty_parts();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_up_unknowns()
  {
    TimerOutput::Scope scope(timer, "set up unknowns");
    matrix.reset();
    const GridSpace<dim> &space = state.grid();

    body_of_cell.assign(space.mesh().triangulation().n_active_cells(), 0);
    for (const auto &in_cell : state.material_points().cells())
      body_of_cell[in_cell.cell->active_cell_index()] =
        state.material_points().body(in_cell.first);

    prescribed.entries.clear();
    if (!conditions.empty())
      prescribed = find_prescribed_nodes(conditions, space, t_start);
    any_prescribed = Utilities::MPI::logical_or(!prescribed.entries.empty(),
                                                space.communicator()) &&
                     !state.is_linear();
    make_constraints();

    // deal.II 9.4 takes a rank without rows for one with too many of them,
    // unless their length is zero (trilinos_sparsity_pattern.cc).
    const unsigned int row_length =
      space.locally_owned().n_elements() > 0 ? Utilities::pow(3, dim) * dim : 0;
    LA::SparsityPattern                  pattern(space.locally_owned(),
                                space.locally_owned(),
                                space.locally_relevant(),
                                space.communicator(),
                                row_length);
    std::vector<types::global_dof_index> dofs;
    const auto couple = [&](const unsigned int *nodes, const unsigned int n) {
      dofs.clear();
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          dofs.push_back(space.node_dof(nodes[a]) + c);
      constraints.add_entries_local_to_global(dofs, pattern, false);
    };
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        couple(space.cell_nodes(cell), space.nodes_per_cell());
    for (unsigned int g = 0; g < state.point_basis().n_groups(); ++g)
      {
        const auto nodes = state.point_basis().group_nodes(g);
        if (nodes.size() != space.nodes_per_cell())
          couple(nodes.data(), nodes.size());
      }
    pattern.compress();
    matrix = std::make_shared<LA::SparseMatrix>();
    matrix->reinit(pattern);
    for (LA::Vector *vector :
         {&residual_vector, &external, &unbalanced, &assembled_at})
      vector->reinit(space.locally_owned(), space.communicator());
    make_rigid_modes();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::make_rigid_modes()
  {
    const GridSpace<dim> &space       = state.grid();
    constexpr unsigned    n_rotations = dim == 2 ? 1 : 3;
    // Assigned to, a Trilinos vector of the same size keeps the layout it has.
    rigid_modes.clear();
    rigid_modes.assign(dim + n_rotations,
                       LA::Vector(space.locally_owned(), space.communicator()));
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = space.node_dof(node) + c;
          if (!space.locally_owned().is_element(dof))
            continue;
          rigid_modes[c](dof) = 1;
          const Point<dim> &x = space.node_position(node);
          // Rotation r turns direction i towards direction j.
          constexpr unsigned int turn[3][2] = {{0, 1}, {1, 2}, {2, 0}};
          for (unsigned int r = 0; r < n_rotations; ++r)
            {
              if (c == turn[r][0])
                rigid_modes[dim + r](dof) = -x[turn[r][1]];
              if (c == turn[r][1])
                rigid_modes[dim + r](dof) = x[turn[r][0]];
            }
        }
    for (auto &mode : rigid_modes)
      mode.compress(VectorOperation::insert);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_target(const double t_end)
  {
    t_target = t_end;
    start_over();
    TimerOutput::Scope scope(timer, "external forces");
    assemble_external_forces();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::start_over()
  {
    assembled      = false;
    last_violation = std::numeric_limits<double>::max();
    for (auto &boundary : boundaries)
      boundary.set_target(t_target);
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::symmetric() const
  {
    // At finite strain a flux and its adjoint refer to different places.
    const bool small = state.strain_measure() == StrainMeasure::small;
    return std::all_of(boundaries.begin(),
                       boundaries.end(),
                       [small](const auto &boundary) {
                         const Enforcement &how = boundary.enforcement();
                         return how.w_free == 0 ||
                                (small && how.adjoint_sign > 0);
                       });
  }



  template <int dim>
  void
  MechanicsSystem<dim>::add_to_system(const LocalSystem<dim> &local,
                                      const bool              tangent)
  {
    const unsigned int n_nodes = local.nodal_increments.size();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        {
          double f = local.force[dim * a + c];
          if (!predicted.empty())
            for (unsigned int b = 0; b < n_nodes; ++b)
              for (unsigned int d = 0; d < dim; ++d)
                f -= local.matrix(dim * a + c, dim * b + d) *
                     predicted[local.nodes[b]][d];
          local_scale += f * f;
          node_forces[local.nodes[a]][c] += f;
        }
    if (tangent)
      constraints.distribute_local_to_global(local.matrix, local.dofs, *matrix);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::assemble(const LA::Vector &x, const bool tangent)
  {
    TimerOutput::Scope scope(timer, tangent ? "assembly" : "residual");
    state.set_trial(x);
    assembled_at             = x;
    const bool first_of_step = !assembled;
    assembled                = true;
    predicting               = first_of_step && tangent && any_prescribed;
    if (predicting)
      {
        predicted = state.nodal_increments();
        state.reject();
      }
    if (tangent)
      *matrix = 0;
    local_scale = 0;
    local_fault.clear();
    node_forces.assign(state.grid().n_nodes(), Tensor<1, dim>());
    assemble_points(tangent);
    assemble_boundaries(tangent);
    assemble_empty_parts(tangent);
    if (tangent)
      matrix->compress(VectorOperation::add);
    state.grid().sum_node_values(node_forces, unbalanced);
    unbalanced += external;
    residual_vector = unbalanced;
    constraints.set_zero(residual_vector);
    scale =
      std::sqrt(Utilities::MPI::sum(local_scale, state.grid().communicator()) +
                external_scale);
    if (first_of_step)
      scale_at_start = scale;
    predicted.clear();
  }



  namespace
  {
    /** The first text of any rank that is not empty. Collective. */
    std::string
    first_of_ranks(const std::string &text, const MPI_Comm &communicator)
    {
      for (const std::string &other :
           Utilities::MPI::all_gather(communicator, text))
        if (!other.empty())
          return other;
      return "";
    }
  } // namespace



  template <int dim>
  std::string
  MechanicsSystem<dim>::fault() const
  {
    return first_of_ranks(local_fault, state.grid().communicator());
  }



  template <int dim>
  std::string
  MechanicsSystem<dim>::fault_of_domains() const
  {
    return first_of_ranks(state.point_basis().fault_of(
                            state.nodal_increments()),
                          state.grid().communicator());
  }



  template <int dim>
  void
  MechanicsSystem<dim>::assemble_points(const bool tangent)
  {
    StencilBlock<dim> block;
    LocalSystem<dim>  local;
    const Basis<dim> &basis = state.point_basis();
    for (unsigned int g = 0; g < basis.n_groups(); ++g)
      {
        basis.evaluate(g, block);
        local.reinit(state, block.nodes, block.n_nodes, tangent);
        for (const auto &term : point_terms)
          term->add(state, block, tangent, local);
        add_to_system(local, tangent && local.fault.empty());
      }
    local_fault = local.fault;
  }



  template <int dim>
  std::vector<BoundaryReport<dim>>
  MechanicsSystem<dim>::accept(const LA::Vector &x)
  {
    state.set_trial(x);
    auto reports = report_boundaries();
    for (const auto &report : report_grid_conditions(x))
      reports.push_back(report);
    for (auto &load : loads.carried)
      if (state.mesh_after_step() != MeshAfterStep::keep)
        load.move(state.grid(), state.nodal_increments());
    {
      TimerOutput::Scope scope(timer, "update and search");
      if (mesh_motion.moves())
        state.accept([this]() {
          moving_mesh->move_vertices([this](const Point<dim> &X) {
            return mesh_motion.map(X, t_start, t_target);
          });
        });
      else
        state.accept();
    }
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      reports[b].penetration =
        Utilities::MPI::max(deepest_point(boundaries[b], {}),
                            state.grid().communicator());
    return reports;
  }



  template class MechanicsSystem<2>;
  template class MechanicsSystem<3>;
} // namespace moraine
