// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mechanics_system.h>

#include <moraine/assembly/couplings.h>
#include <moraine/assembly/rigid_motion_check.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Typical size of the largest point. */
    template <int dim>
    double
    point_size(const State<dim> &state)
    {
      double               volume = 0;
      const PointSet<dim> &points = state.material_points();
      for (unsigned int p = 0; p < points.n_local(); ++p)
        volume = std::max(volume, points.volume(p));
      return std::pow(Utilities::MPI::max(volume, state.grid().communicator()),
                      1. / dim);
    }



    /** All entries are no numbers: where every node of a point without stress
     * is prescribed, condensed forces say nothing of it. */
    void
    make_invalid(LA::Vector &residual)
    {
      std::fill(residual.begin(),
                residual.end(),
                std::numeric_limits<double>::quiet_NaN());
    }



    /** The first text of any rank that is not empty. Collective. */
    std::string
    first_of_ranks(const std::string &text, const MPI_Comm &communicator)
    {
      // Nearly always there is none.
      if (!Utilities::MPI::logical_or(!text.empty(), communicator))
        return "";
      for (const std::string &other :
           Utilities::MPI::all_gather(communicator, text))
        if (!other.empty())
          return other;
      return "";
    }
  } // namespace



  template <int dim>
  MechanicsSystem<dim>::MechanicsSystem(
    State<dim>                     &state,
    Terms<dim>                      terms,
    const std::vector<std::string> &body_names,
    TimerOutput                    *timer)
    : state(state)
    , terms(std::move(terms))
    , body_names(body_names)
    , unused_timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , timer(timer ? *timer : unused_timer)
    , context(state)
  {}



  template <int dim>
  void
  MechanicsSystem<dim>::move_mesh_by(const MeshMotion<dim> &motion,
                                     BackgroundMesh<dim>   &mesh)
  {
    context.mesh_moves = motion.moves();
    if (motion.moves())
      move_mesh = [this, motion, &mesh]() {
        mesh.move_vertices([&](const Point<dim> &X) {
          return motion.map(X, context.t_start, context.t_end);
        });
      };
  }



  template <int dim>
  void
  MechanicsSystem<dim>::add(std::unique_ptr<Term<dim>> term)
  {
    terms.push_back(std::move(term));
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_terms(Terms<dim> others)
  {
    terms = std::move(others);
    // What they couple is not known.
    sums.clear();
    forces.at_start = LA::Vector();
  }



  template <int dim>
  std::vector<Effect>
  MechanicsSystem<dim>::effects() const
  {
    std::vector<Effect> all;
    for (const auto &term : terms)
      for (const Effect &effect : term->effects(context))
        all.push_back(effect);
    return all;
  }



  template <int dim>
  void
  MechanicsSystem<dim>::begin_step(
    const double                 t,
    const std::function<void()> &before_new_tangent)
  {
    context.t_start = context.t_end = t;
    const auto holds_mean_in        = [this](const auto &cell) {
      return std::any_of(terms.begin(), terms.end(), [&](const auto &term) {
        return term->holds_mean_in(context, cell);
      });
    };
    {
      TimerOutput::Scope scope(timer, "stencils");
      // The first of this system need not be the first of the state.
      context.couplings_changed =
        state.begin_step(holds_mean_in) || !sums.matrix();
    }
    if (context.motion)
      context.motion->begin_step();
    context.cells_moved =
      context.couplings_changed || context.mesh_moves ||
      state.mesh_after_step() == MeshAfterStep::follow_material;
    context.search_tolerance = point_size(state);
    context.cell_materials.update(state);
    try
      {
        begin_terms();
      }
    catch (...)
      {
        // What is new by now is not told again.
        sums.clear();
        throw;
      }
    if (context.couplings_changed)
      {
        if (before_new_tangent)
          before_new_tangent();
        set_up_unknowns();
      }
    else if (context.cells_moved)
      rigid_modes = rigid_modes_of(state.grid());
    if (!context.motion || forces_in_the_middle())
      return;
    find_forces_at_start();
    weigh_forces_at_start();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::begin_terms()
  {
    bool new_couplings = context.couplings_changed;
    for (const auto &term : terms)
      {
        std::unique_ptr<TimerOutput::Scope> scope;
        if (const std::string section = term->traits().timer; !section.empty())
          scope = std::make_unique<TimerOutput::Scope>(timer, section);
        new_couplings = term->begin_step(context) || new_couplings;
      }
    context.couplings_changed =
      Utilities::MPI::logical_or(new_couplings, state.grid().communicator());
  }



  template <int dim>
  ConstraintTable::AddLines
  MechanicsSystem<dim>::lines_of_terms() const
  {
    return [this](AffineConstraints<double> &lines) {
      for (const auto &term : terms)
        term->constrain(context, lines);
    };
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_up_unknowns()
  {
    TimerOutput::Scope scope(timer, "set up unknowns");
    sums.clear();
    const GridSpace<dim> &space = state.grid();
    constraints.reinit(space.locally_relevant(),
                       space.communicator(),
                       lines_of_terms(),
                       context.motion == nullptr);

    Couplings<dim> couplings(space);
    const auto couple = [&](const unsigned int *nodes, const unsigned int n) {
      couplings.add(nodes, n);
    };
    std::vector<unsigned int> nodes_of_mean;
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        {
          couple(space.cell_nodes(cell), space.nodes_per_cell());
          state.nodes_of_mean(cell->active_cell_index(), nodes_of_mean);
          if (nodes_of_mean.size() > space.nodes_per_cell())
            couple(nodes_of_mean.data(), nodes_of_mean.size());
        }
    for (unsigned int g = 0; g < state.point_basis().n_batches(); ++g)
      {
        const auto nodes = state.nodes_of_batch(g);
        if (nodes.size() != space.nodes_per_cell())
          couple(nodes.data(), nodes.size());
      }
    for (const auto &term : terms)
      term->couple(context, couple);
    bodies = find_bodies_of_nodes(state, body_names.size());
    sums.reinit(
      space, constraints, couplings, bodies.of_node, body_names.size());
    for (LA::Vector *vector :
         {&residual_vector, &forces.dead, &unbalanced, &assembled_at})
      *vector = space.vector();
    rigid_modes = rigid_modes_of(space);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::check_values(const double t)
  {
    context.t_end = t;
    for (const auto &term : terms)
      term->check_values(context);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::set_target(const double t_end)
  {
    context.t_end = t_end;
    state.set_step_time({context.t_start, context.t_end});
    start_over();
    if (constraints.any_lines())
      constraints.set_values(lines_of_terms());
    if (context.motion)
      set_target_of_motion();
    find_dead_forces();
  }



  template <int dim>
  void
  MechanicsSystem<dim>::start_over()
  {
    assembled      = false;
    last_violation = std::numeric_limits<double>::max();
    each<ConstraintTerm<dim>>(
      [this](auto &term) { term.begin_trial(context); });
  }



  template <int dim>
  void
  MechanicsSystem<dim>::initial_guess(LA::Vector &x) const
  {
    x.reinit(state.grid().locally_owned(), state.grid().communicator());
    constraints.distribute(x);
  }



  template <int dim>
  void
  MechanicsSystem<dim>::apply_constraints(LA::Vector &dx) const
  {
    constraints.distribute_correction(dx);
  }



  template <int dim>
  double
  MechanicsSystem<dim>::displacement_scale() const
  {
    double scale = state.strain_measure() == StrainMeasure::finite ?
                     state.grid().mesh().cell_size() :
                     0.;
    each<ConstraintTerm<dim>>([&scale](const auto &term) {
      scale = std::max(scale, term.rounded_length());
    });
    return scale;
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::symmetric() const
  {
    return !constraints.any_taken() &&
           std::all_of(terms.begin(), terms.end(), [this](const auto &term) {
             return term->symmetric(context);
           });
  }



  template <int dim>
  void
  MechanicsSystem<dim>::add_point_terms(const Which &which, const bool tangent)
  {
    std::vector<std::pair<unsigned int, const PointTerm<dim> *>> point_terms;
    for (unsigned int i = 0; i < terms.size(); ++i)
      if (const auto *of_points =
            dynamic_cast<PointTerm<dim> *>(terms[i].get()))
        if (which(*terms[i]))
          point_terms.emplace_back(i, of_points);
    if (point_terms.empty())
      return;
    StencilBlock<dim> block;
    LocalSystem<dim>  local;
    const Basis<dim> &basis = state.point_basis();
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        state.evaluate(g, block);
        local.reinit(state, block.nodes, block.n_nodes, tangent);
        double before = 0;
        for (const auto &[i, term] : point_terms)
          {
            term->add(context, block, tangent, local);
            if (!sums.counts_work())
              continue;
            const double work = local.work();
            count_work(i, work - before);
            before = work;
          }
        sums.add(local, tangent && local.failure.empty());
      }
  }



  template <int dim>
  void
  MechanicsSystem<dim>::add_terms(const Which &which, const bool tangent)
  {
    scale.stabilising_squares.assign(terms.size(), 0.);
    forces.works_of_terms.assign(terms.size(), 0.);
    add_point_terms(which, tangent);
    for (unsigned int i = 0; i < terms.size(); ++i)
      if (which(*terms[i]))
        {
          const double before      = sums.sum_of_squares();
          const double work_before = sums.work();
          terms[i]->add(context, tangent, sums);
          count_work(i, sums.work() - work_before);
          if (terms[i]->traits().stabilises)
            scale.stabilising_squares[i] = sums.sum_of_squares() - before;
        }
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
    predicting =
      first_of_step && tangent && constraints.any_lines() && !state.is_linear();
    std::vector<Tensor<1, dim>> predicted;
    if (predicting)
      {
        predicted = state.nodal_increments();
        state.reject();
      }
    sums.count_work(
      context.motion ||
      std::any_of(terms.begin(), terms.end(), [](const auto &term) {
        return term->traits().stabilises;
      }));
    sums.begin(tangent, predicted);
    forces.works.fill(0.);
    add_terms([](const auto &term) { return !term.traits().is_dead; }, tangent);
    sums.end(unbalanced);
    unbalanced += forces.dead;
    if (forces.at_start.size() > 0)
      unbalanced += forces.at_start;
    residual_vector = unbalanced;
    constraints.condense(residual_vector);
    if (!failure().empty())
      make_invalid(residual_vector);
    scale.of_bodies.resize(body_names.size());
    Utilities::MPI::sum(sums.squares_of_bodies(),
                        state.grid().communicator(),
                        scale.of_bodies);
    double squares = 0;
    for (unsigned int b = 0; b < body_names.size(); ++b)
      {
        const double of_body = scale.of_bodies[b] + scale.dead_squares[b];
        squares += of_body;
        scale.of_bodies[b] = std::sqrt(of_body);
      }
    scale.now = std::sqrt(squares);
    if (first_of_step)
      scale.at_start = scale.now;
  }



  template <int dim>
  std::string
  MechanicsSystem<dim>::failure() const
  {
    return first_of_ranks(sums.failure(), state.grid().communicator());
  }



  template <int dim>
  std::string
  MechanicsSystem<dim>::place_of(const types::global_dof_index unknown) const
  {
    const GridSpace<dim> &space = state.grid();
    std::ostringstream    text;
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      if (space.node_dof(node) <= unknown &&
          unknown < space.node_dof(node) + dim &&
          space.locally_owned().is_element(unknown))
        text << "the node at (" << std::setprecision(3)
             << space.node_position(node) << ')';
    return first_of_ranks(text.str(), space.communicator());
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::acts_otherwise() const
  {
    bool any = false, can = false;
    for (const auto &term : terms)
      if (const auto *of =
            dynamic_cast<const ConstraintTerm<dim> *>(term.get()))
        {
          can = can || of->traits().has_statuses;
          any = any || of->acts_otherwise(context);
        }
    return can && Utilities::MPI::logical_or(any, state.grid().communicator());
  }



  template <int dim>
  bool
  MechanicsSystem<dim>::augment(const LA::Vector &x, const double tolerance)
  {
    // Of tractions: displacements of a cell are wrong by a tenth of that.
    const double   settled      = 1e5 * tolerance;
    const MPI_Comm communicator = state.grid().communicator();
    state.set_trial(x);
    double violation = 0, motion = 0;
    bool   must_go_on = false, slides = false;
    for (const auto &u : state.nodal_increments())
      motion = std::max(motion, u.norm());
    each<ConstraintTerm<dim>>([&](const auto &term) {
      if (term.is_settled(context, settled))
        return;
      const double of_term = term.violation(context);
      const double left    = term.largest_violation_left(context);
      violation            = std::max(violation, of_term);
      must_go_on           = must_go_on || of_term > left;
      slides = slides || left < std::numeric_limits<double>::max();
    });
    must_go_on = Utilities::MPI::logical_or(must_go_on, communicator);
    violation  = Utilities::MPI::max(violation, communicator);
    motion     = Utilities::MPI::max(motion, communicator);
    // Stop when the constraint holds to round-off or gets no better, and where
    // it holds well when it gets little better: some ways in which nodes
    // alternate along a surface have next to no mean in a cell. What slides
    // settles slowly.
    const double little = violation <= 1e-10 * motion ? 0.3 :
                          slides                      ? 0.9 :
                                                        0.5;
    if (violation <= 1e-14 * motion ||
        (violation > little * last_violation && !must_go_on))
      return false;
    last_violation = violation;
    each<ConstraintTerm<dim>>([this](auto &term) { term.augment(context); });
    return true;
  }



  template <int dim>
  typename MechanicsSystem<dim>::Share
  MechanicsSystem<dim>::share(const Which &which) const
  {
    const MPI_Comm      communicator = state.grid().communicator();
    std::vector<double> squares(scale.stabilising_squares);
    std::vector<double> works(forces.works_of_terms);
    Utilities::MPI::sum(squares, communicator, squares);
    Utilities::MPI::sum(works, communicator, works);
    double of_which = 0, work = 0, largest = 0;
    // A body that flies has hardly any work to compare with.
    if (context.motion)
      largest = std::max(context.motion->works().kinetic_at_start,
                         context.motion->works().kinetic);
    for (unsigned int i = 0; i < terms.size(); ++i)
      if (which(*terms[i]))
        {
          of_which += squares[i];
          work += works[i];
        }
      else
        largest = std::max(largest, std::abs(works[i]));
    // A step may end without any force.
    const double all_forces = std::max(scale.now, scale.at_start);
    return {all_forces > 0 ? std::sqrt(of_which) / all_forces : 0.,
            largest > 0 ? std::abs(work) / largest : 0.};
  }



  template <int dim>
  std::string
  MechanicsSystem<dim>::reason_to_reject(const LA::Vector &x)
  {
    state.set_trial(x);
    const std::string of_domains =
      first_of_ranks(state.point_basis().failure_of(state.nodal_increments()),
                     state.grid().communicator());
    if (!of_domains.empty())
      return of_domains;
    std::vector<Tensor<1, dim>> moves;
    if (std::any_of(terms.begin(), terms.end(), [](const auto &term) {
          return term->traits().watches_points;
        }))
      moves = state.point_increments();
    for (const auto &term : terms)
      {
        const std::string reason = term->failure(context, moves);
        if (!reason.empty())
          return reason;
      }
    return "";
  }



  template <int dim>
  void
  MechanicsSystem<dim>::check_that_it_is_held(const bool first_step) const
  {
    if (context.motion)
      return; // by inertia
    check_rigid_motion(context,
                       *sums.matrix(),
                       constraints,
                       rigid_modes,
                       body_names,
                       first_step);
  }



  template <int dim>
  std::string
  MechanicsSystem<dim>::why_not_held() const
  {
    if (context.couplings_changed)
      try
        {
          check_that_it_is_held(false);
        }
      catch (const ComputationError &error)
        {
          return error.what();
        }
    return "";
  }



  template <int dim>
  std::vector<BoundaryReport<dim>>
  MechanicsSystem<dim>::accept(const LA::Vector &x)
  {
    if (std::any_of(terms.begin(), terms.end(), [](const auto &term) {
          return term->traits().wants_unbalanced_forces;
        }))
      assemble_forces_at(x);
    state.set_trial(x);
    typename Motion<dim>::StepWorks works;
    if (context.motion)
      works = works_of_step(x);
    constraints.hand_over_ties(unbalanced);
    for (const auto &term : terms)
      term->prepare(context, unbalanced);
    {
      TimerOutput::Scope scope(timer, "update and search");
      if (context.motion)
        context.motion->accept(works);
      StepEnergies energies;
      state.accept(move_mesh, context.motion ? &energies : nullptr);
      if (context.motion)
        context.motion->count(energies);
    }
    for (const auto &term : terms)
      term->keep();
    std::vector<BoundaryReport<dim>> reports;
    for (const auto &term : terms)
      term->report(context, reports);
    return reports;
  }



  template class MechanicsSystem<2>;
  template class MechanicsSystem<3>;
} // namespace moraine
