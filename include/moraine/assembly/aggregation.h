// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_aggregation_h
#define moraine_assembly_aggregation_h

#include <moraine/assembly/term.h>

#include <vector>

namespace moraine
{
  /**
   * The ties of Aggregates as lines @f$\Delta u_i = \sum_a N_a(x_i)\, \Delta
   * u_a@f$, the functions those of the root's nodes @f$a@f$. Components that
   * something else prescribes are left to it.
   */
  template <int dim>
  class Aggregation : public Term<dim>
  {
  public:
    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    void
    constrain(const StepContext<dim>            &context,
              dealii::AffineConstraints<double> &lines) const override;
  };



  /**
   * The ties of Aggregates as springs, which give way: forces that are minus
   * the derivative of
   *
   * @f[ \frac{\gamma_g}{2} \sum_i s_i \Big| q_i - \sum_a N_a(x_i)\, q_a \Big|^2
   * , @f]
   *
   * i the tied nodes, a those of the root, q what a derived class ties, @f$s_i
   * > 0@f$ its scale in the root (the weak form of aggregation by Badia, Neiva,
   * Verdugo 2021, arXiv:2106.13728, at nodes in place of cut cells). The forces
   * of a tie sum up to none and have no moment; linear q are free. Components
   * of the node that a strong condition prescribes are left to it. Nothing is
   * carried from step to step.
   */
  template <int dim>
  class GhostTerm : public Term<dim>
  {
  public:
    /** @p factor is @f$\gamma_g > 0@f$. */
    explicit GhostTerm(const double factor);

    /** It stores nothing from one step to the next. */
    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind  = WorkKind::damping;
      is.stabilises = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &) const override
    {
      return {};
    }

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    couple(const StepContext<dim>           &context,
           const typename Term<dim>::Couple &couple_nodes) const override;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

  protected:
    const double factor; ///< @f$\gamma_g@f$

  private:
    using Tie = typename Aggregates<dim>::Tie;

    /** Of the material at a point. @f$s_i@f$ is the mean over the points of the
     * root, by volume, ... */
    virtual double
    of_point(const State<dim> &state, const unsigned int p) const = 0;

    /** ... times this, of the volume of the root. */
    virtual double
    of_volume(const double volume) const = 0;

    /** @f$q@f$ in the trial state. */
    virtual dealii::Tensor<1, dim>
    value(const StepContext<dim>       &context,
          const unsigned int            node,
          const dealii::Tensor<1, dim> &du) const = 0;

    /** Its derivative by @f$\Delta u@f$. */
    virtual double
    value_by_increment(const StepContext<dim> &context) const = 0;

    /** A tie of a node of this rank. */
    struct Held
    {
      unsigned int tie;   ///< in Aggregates::ties()
      double       scale; ///< @f$\gamma_g s_i@f$
    };

    /** @f$s_i@f$ of roots, by active_cell_index(). Collective. */
    std::vector<double>
    scales_of_roots(const StepContext<dim> &context) const;

    std::vector<Held> held;
  };



  /**
   * Holds increments, @f$q = \Delta u@f$, by @f$s = G\,h^{n-2}@f$: h the size
   * of the root, n the dimension, G its shear modulus at the start of the step,
   * the mean over the deviatoric directions in principal axes of the material's
   * tangent if points are loaded on as they are, at least a hundredth of the
   * elastic one. So what flows or softens is held less. Materials that are not
   * isotropic have their elastic stiffness.
   */
  template <int dim>
  class GhostStiffness : public GhostTerm<dim>
  {
  public:
    using GhostTerm<dim>::GhostTerm;

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

  private:
    double
    of_point(const State<dim> &state, const unsigned int p) const override;

    double
    of_volume(const double volume) const override;

    dealii::Tensor<1, dim>
    value(const StepContext<dim> &,
          const unsigned int,
          const dealii::Tensor<1, dim> &du) const override
    {
      return du;
    }

    double
    value_by_increment(const StepContext<dim> &) const override
    {
      return 1.;
    }
  };



  /**
   * Holds accelerations where the integrator wants forces of inertia, by
   * @f$s = \rho\,h^n@f$: nodes of next to no mass do not run away.
   */
  template <int dim>
  class GhostMass : public GhostTerm<dim>
  {
  public:
    using GhostTerm<dim>::GhostTerm;

    TermTraits
    traits() const override
    {
      TermTraits is = GhostTerm<dim>::traits();
      is.is_inertia = true;
      return is;
    }

  private:
    double
    of_point(const State<dim> &state, const unsigned int p) const override;

    double
    of_volume(const double volume) const override;

    dealii::Tensor<1, dim>
    value(const StepContext<dim>       &context,
          const unsigned int            node,
          const dealii::Tensor<1, dim> &du) const override;

    double
    value_by_increment(const StepContext<dim> &context) const override;
  };
} // namespace moraine

#endif
