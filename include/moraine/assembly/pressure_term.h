// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_pressure_term_h
#define moraine_assembly_pressure_term_h

#include <moraine/assembly/load_terms.h>

#include <vector>

namespace moraine
{
  /**
   * A pressure that stays normal to the surface that the material carries, at
   * finite strain,
   * @f[
   *   f_a = -\sum_k p(x_k, t)\, N_a(x_k)\, w_k\, \mathrm{cof}(F_k)\, n_k,
   *   \qquad F_k = 1 + \nabla \Delta u(x_k),
   * @f]
   * with areas @f$w_k@f$, normals @f$n_k@f$ and places @f$x_k@f$ at the start
   * of the step (Nanson's formula). Its derivative,
   * @f$d(\mathrm{cof}(F)\, n) = du \times F (n \times \nabla N)@f$, is not
   * symmetric. Where an integrator asks for the forces of the middle of a step,
   * they are the mean along the step, by which the work of a uniform pressure
   * is p times the change of volume.
   */
  template <int dim>
  class PressureTerm : public CarriedLoadTerm<dim>
  {
  public:
    using CarriedLoadTerm<dim>::CarriedLoadTerm;

    bool
    begin_step(const StepContext<dim> &context) override;

    TermTraits
    traits() const override
    {
      return {};
    }

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    bool
    symmetric(const StepContext<dim> &) const override
    {
      return false;
    }

  private:
    /** Places of this rank that see the same nodes. */
    struct Group
    {
      std::vector<unsigned int>           nodes;
      std::vector<unsigned int>           places;
      std::vector<double>                 N;      ///< of forces, place major
      std::vector<dealii::Tensor<1, dim>> grad_N; ///< of motion
    };

    /** @p forces push the nodes, @p motion moves the places. */
    void
    find_groups(const GridSpace<dim>      &space,
                const PlaceFunctions<dim> &forces,
                const PlaceFunctions<dim> &motion);

    /** Of one place of a group, with @p n its area vector at the start times
     * minus the pressure. */
    void
    add_place(const StepContext<dim>       &context,
              const dealii::Tensor<1, dim> &n,
              const double                 *N,
              const dealii::Tensor<1, dim> *grad_N,
              const bool                    tangent,
              LocalSystem<dim>             &local) const;

    std::vector<Group> groups;
  };
} // namespace moraine

#endif
