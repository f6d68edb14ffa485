// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_load_terms_h
#define moraine_assembly_load_terms_h

#include <moraine/assembly/term.h>
#include <moraine/load/load.h>

namespace moraine
{
  /** @f$\sum_p N_a b\, v_p@f$, or gravity @f$\sum_p N_a g\, m_p@f$. */
  template <int dim>
  class BodyForceTerm : public PointTerm<dim>
  {
  public:
    explicit BodyForceTerm(const BodyForce<dim> &force);

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.is_dead = true;
      return is;
    }

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

  private:
    const BodyForce<dim> &force;
  };

  /** @f$\sum_p N_a F/n@f$ over some points. */
  template <int dim>
  class ForceOnPointsTerm : public PointTerm<dim>
  {
  public:
    explicit ForceOnPointsTerm(ForceOnPoints<dim> &force);

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.is_dead = true;
      return is;
    }

    using PointTerm<dim>::add;

    void
    add(const StepContext<dim>  &context,
        const StencilBlock<dim> &block,
        const bool               tangent,
        LocalSystem<dim>        &local) const override;

  private:
    ForceOnPoints<dim> &force;
  };

  /** @f$\sum_k w_k N_a(x_k)\, t@f$ over places that the material carries. */
  template <int dim>
  class CarriedLoadTerm : public Term<dim>
  {
  public:
    /** If it does not act yet, the material carries its places all the same.
     */
    explicit CarriedLoadTerm(CarriedLoad<dim> &load, const bool acts = true);

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.is_dead = true;
      return is;
    }

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    void
    prepare(const StepContext<dim> &context,
            const LA::Vector       &unbalanced) override;

    void
    keep() noexcept override;

  protected:
    /** By which its places push the nodes. Collective. */
    PlaceFunctions<dim>
    functions_of_forces(const StepContext<dim> &context) const;

    CarriedLoad<dim> &load;

  private:
    const bool acts;
  };
} // namespace moraine

#endif
