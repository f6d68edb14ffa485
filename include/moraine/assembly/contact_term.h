// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_contact_term_h
#define moraine_assembly_contact_term_h

#include <moraine/assembly/contact_flux.h>
#include <moraine/assembly/term.h>
#include <moraine/boundary/contact_boundary.h>

#include <vector>

namespace moraine
{
  /** Function of a node and gradients of CellFlux, integrated over a unit of
   * contact, or the part of it on one rank. */
  template <int dim>
  struct ContactEntry
  {
    unsigned int                    unit;
    dealii::types::global_dof_index dof; ///< first of a node
    double                          N = 0;
    /** If there is a flux. */
    typename CellFlux<dim>::Gradients gradients = {};

    template <class BoostArchive>
    void
    serialize(BoostArchive &archive, const unsigned int)
    {
      archive &unit &dof &N &gradients.own &gradients.mean;
    }
  };

  /**
   * The contact forces of a rigid surface on the bodies. Each unit adds, with
   * the mean @f$\bar N_a@f$ of the functions over its part of the rim,
   *
   * @f[ f_a = |\Gamma_u|\, \bar N_a\, P(\tau^{tr}), \qquad
   *     \tau^{tr} = t + c_n\, g\, n - c_t\, (1 - n \otimes n)
   *     (\Delta u - \Delta g), \quad c_n = c_3 (\lambda + 2\mu),\;
   *     c_t = c_3\, \mu, @f]
   *
   * with P of ContactLaw and t the traction of the last pass (augmented
   * Lagrangian). Its tangent @f$|\Gamma_u|\, \bar N_a\, DP\, C \bar N_b@f$ is
   * unsymmetric in slip.
   *
   * Nitsche's method has no passes: its t is the traction of the stress of the
   * points in the cells of the unit at the start of the step, with the shear
   * that has slipped elastically, @f$t = \bar\sigma n - c_t\, s_e@f$, and the
   * trial traction has the flux of the displacements of the step,
   * @f$f = \sum_b f_b u_b@f$. The adjoint of the flux is left out (the
   * incomplete form of Chouly, Hild and Renard 2015; there at places, here of
   * means): where material yields, f is not what the stress changes by, and the
   * adjoint would make forces of the difference; without it the gap is off by
   * the difference over c_n, until the next step.
   */
  template <int dim>
  class ContactTerm : public ConstraintTerm<dim>
  {
  public:
    /** If it does not act yet, the material carries its places all the same.
     */
    ContactTerm(ContactBoundary<dim>    &boundary,
                const std::vector<bool> &bodies_present,
                const bool               acts = true);

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind    = WorkKind::boundaries;
      is.timer        = "boundary pieces";
      is.has_statuses = true;
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    couple(const StepContext<dim>           &context,
           const typename Term<dim>::Couple &couple) const override;

    void
    begin_trial(const StepContext<dim> &context) override;

    void
    move_trial(const StepContext<dim> &context) override;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    bool
    symmetric(const StepContext<dim> &context) const override;

    double
    violation(const StepContext<dim> &context) const override;

    /** A gap is the distance of places. */
    double
    rounded_length() const override;

    bool
    acts_otherwise(const StepContext<dim> &context) const override;

    bool
    is_settled(const StepContext<dim> &context,
               const double            tolerance) const override;

    double
    largest_violation_left(const StepContext<dim> &context) const override;

    void
    augment(const StepContext<dim> &context) override;

    std::string
    failure(const StepContext<dim>                    &context,
            const std::vector<dealii::Tensor<1, dim>> &moves) const override;

    /** A force of the start of a step belongs to another gap and would add
     * energy in impacts. */
    bool
    acts_over_step(const StepContext<dim> &context) const override
    {
      return context.motion && context.motion->integrator().start_forces() > 0;
    }

    /** Forces at the end, over the whole step. */
    double
    work_of_step(const StepContext<dim> &context,
                 const double            of_force) const override
    {
      return of_force / (1. + this->share_of_start(context));
    }

    void
    prepare(const StepContext<dim> &context,
            const LA::Vector       &unbalanced) override;

    void
    keep() noexcept override;

    void
    report(const StepContext<dim>           &context,
           std::vector<BoundaryReport<dim>> &reports) const override;

  private:
    /** A unit, or this rank's part of one, with its functions. */
    struct LocalUnit
    {
      unsigned int              number; ///< of ContactBoundary::units()
      double                    area;
      std::vector<unsigned int> nodes;
      std::vector<double>       N; ///< means
      double                    c_n, c_t;
      /** Flux of the unit displacements of nodes: @f$f_b@f$; or none. */
      std::vector<dealii::Tensor<2, dim>>            fluxes;
      std::vector<typename CellFlux<dim>::Gradients> gradients; ///< means
    };

    /** A unit in the trial state. */
    struct Trial
    {
      dealii::Tensor<1, dim> du;
      ContactGap<dim>        gap;
      dealii::Tensor<1, dim> multiplier; ///< t, turned with the normal
      dealii::Tensor<1, dim> flux;       ///< f
      ContactResponse<dim>   response;
    };

    /** Whether the first cell of a unit is one of this rank. */
    bool
    owns(const ContactUnit<dim> &unit) const;

    /** Whether it couples no nodes but those of a cell of this rank. */
    bool
    is_in_its_cell(const GridSpace<dim> &space, const LocalUnit &unit) const;

    std::vector<ContactEntry<dim>>
    entries_of_this_rank(const StepContext<dim> &context,
                         const CellFluxes<dim>  &fluxes) const;

    /** Of the cells of units of this rank, if there is a flux. */
    CellFluxes<dim>
    find_fluxes(const StepContext<dim> &context) const;

    /** Let the step begin with the tractions of @p fluxes; without points in a
     * cell, with the traction that is carried there. Collective. */
    void
    start_from(const CellFluxes<dim> &fluxes, const StepContext<dim> &context);

    /** Find the functions of units. Collective. */
    void
    find_local_units(const StepContext<dim> &context,
                     const CellFluxes<dim>  &fluxes);

    void
    find_stiffness(const StepContext<dim> &context);

    Trial
    trial(const StepContext<dim> &context, const LocalUnit &unit) const;

    /** The end of the step of all units, and what the report says of forces.
     * Collective. */
    std::vector<typename ContactBoundary<dim>::OfUnit>
    sum_units(const StepContext<dim> &context);

    /** Add what the flux of a unit adds to the matrix; @p derivative is that of
     * the traction by the trial traction. */
    static void
    add_stiffness_of_flux(const LocalUnit              &unit,
                          const dealii::Tensor<2, dim> &derivative,
                          LocalSystem<dim>             &local);

    /** The response at the start of the step. */
    ContactResponse<dim>
    response_at_start(const LocalUnit &local, const Trial &trial) const;

    /**
     * The response where nothing has moved yet, linearised about the start of
     * the step, so that a surface that moves takes along what touches it, and
     * the first correction brings a body that nothing holds to it. What slid
     * sticks if the surface turns back.
     *
     * @param traction the trial traction
     * @param local the unit
     * @param trial its trial; gets the response
     */
    void
    linearise(const dealii::Tensor<1, dim> &traction,
              const LocalUnit              &local,
              Trial                        &trial) const;

    ContactBoundary<dim>   &boundary;
    const std::vector<bool> bodies_present;
    const bool              acts;
    std::vector<LocalUnit>  local_units;
    /** Whether local units touched, of each tangent since the last pass but the
     * linearised one. */
    mutable std::vector<std::vector<bool>> touched;
    /** Whether no tangent was added since the trial began. */
    mutable bool                           nothing_moved = true;
    std::vector<std::vector<unsigned int>> coupled_before;
    BoundaryReport<dim>                    prepared;
  };
} // namespace moraine

#endif
