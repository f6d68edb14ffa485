// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_fading_forces_h
#define moraine_assembly_fading_forces_h

#include <moraine/assembly/term.h>
#include <moraine/state/node_values.h>

namespace moraine
{
  /**
   * Forces r that are out of balance at the start @f$t_0@f$ of a static step,
   * as where a load comes at once, come in parts until the end @f$t_1@f$ of
   * that step: shorter steps before it have
   *
   * @f[ -\frac{t_1 - t}{t_1 - t_0}\, r @f]
   *
   * besides. Nothing is left of that at @f$t_1@f$.
   */
  template <int dim>
  class FadingForces : public StatePart
  {
  public:
    explicit FadingForces(const GridSpace<dim> &space)
      : forces(space, "run/fading_forces/node", "force")
    {}

    /** Let these forces of nodes come from now, @p start, to @p end. */
    void
    begin(const std::vector<dealii::Tensor<1, dim>> &forces_now,
          const double                               start,
          const double                               end);

    /** Whether some of them are still to come at @p t. */
    bool
    acts_at(const double t) const
    {
      return t < t_end;
    }

    /** The part of them that is still to come at @p t. */
    double
    share(const double t) const
    {
      return acts_at(t) ? (t_end - t) / (t_end - t_start) : 0.;
    }

    /** Find the nodes as they are in the step from @p t on. Collective. */
    void
    begin_step(const double t)
    {
      of_nodes =
        acts_at(t) ? forces.of_nodes() : std::vector<dealii::Tensor<1, dim>>();
    }

    /** r, of nodes in this step; none where nothing acts. */
    const std::vector<dealii::Tensor<1, dim>> &
    nodal_forces() const
    {
      return of_nodes;
    }

    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    bool has_term = false; ///< among those of the system

  private:
    NodeValuesRecord<dim>               forces;
    std::vector<dealii::Tensor<1, dim>> of_nodes; ///< in this step
    double                              t_start = 0, t_end = 0;
  };



  /** Adds FadingForces. */
  template <int dim>
  class FadingForcesTerm : public Term<dim>
  {
  public:
    explicit FadingForcesTerm(FadingForces<dim> &forces)
      : forces(forces)
    {}

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.is_dead = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &) const override
    {
      return {};
    }

    bool
    begin_step(const StepContext<dim> &context) override
    {
      forces.begin_step(context.t_start);
      return false;
    }

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

  private:
    FadingForces<dim> &forces;
  };
} // namespace moraine

#endif
