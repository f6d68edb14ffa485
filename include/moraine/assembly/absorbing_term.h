// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_absorbing_term_h
#define moraine_assembly_absorbing_term_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/absorbing_boundary.h>

#include <optional>
#include <vector>

namespace moraine
{
  /**
   * The forces of an AbsorbingBoundary, with the material beside it: in a step
   *
   * @f[ t_{n+1} = t_0 - C\, (v_{n+1} - 2 v_{in})
   *     - K\, (e_n + \Delta u - \Delta u_{in}) , @f]
   *
   * e being the extension of the springs; areas and normals are those at its
   * start. An integrator with forces in the middle of the step gets those
   * there. Phuong et al. 2023, eqs. (9) to (16), where the square root must
   * cover all of @f$E(1-\nu)/(\rho(1+\nu)(1-2\nu))@f$ and the sign of (15) and
   * (16) is that of (12). In quasi-static steps the springs act alone.
   */
  template <int dim>
  class AbsorbingTerm : public Term<dim>
  {
  public:
    /** If it does not act, the material carries its places all the same, and
     * its springs are attached anew when it does. */
    explicit AbsorbingTerm(AbsorbingBoundary<dim> &boundary,
                           const bool              acts = true);

    TermTraits
    traits() const override
    {
      TermTraits is;
      is.work_kind = WorkKind::absorbed;
      is.timer     = "boundary pieces";
      return is;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    check_values(const StepContext<dim> &context) override;

    void
    add(const StepContext<dim> &context,
        const bool              tangent,
        GlobalSystem<dim>      &system) const override;

    void
    prepare(const StepContext<dim> &context,
            const LA::Vector       &unbalanced) override;

    void
    keep() noexcept override;

    void
    report(const StepContext<dim>           &context,
           std::vector<BoundaryReport<dim>> &reports) const override;

    /**
     * Hold from now on, as tractions, the forces that the surface put on nodes
     * so far, as a constraint did that ends now: @f$t_0 = \sum_a N_a
     * \lambda_a@f$ with @f$\sum_b \int N_a N_b\,d\Gamma\, \lambda_b = f_a@f$ at
     * the nodes around it in the least squares, and a rigid field that makes
     * resultant and moment those of the forces, so that a body that was in
     * equilibrium does not drift. To be called in a step that has begun.
     * @return what of @p forces no traction on the surface can give, as a
     * fraction; nothing if the surface is not @p name. Collective.
     */
    std::optional<double>
    hold(const StepContext<dim> &context,
         const std::string      &name,
         const LA::Vector       &forces);

  private:
    using Matrix = dealii::SymmetricTensor<2, dim>;
    using Vector = dealii::Tensor<1, dim>;

    /** A place in a cell of this rank. */
    struct LocalPlace
    {
      unsigned int number;
      unsigned int cell;
      Matrix       dashpots, springs;
    };

    void
    find_local_places(const StepContext<dim> &context);

    /** At a local place, where nodes move by @p increments in cell order. */
    Vector
    traction(const StepContext<dim>    &context,
             const unsigned int         q,
             const std::vector<Vector> &increments) const;

    /** @f$\sum_a N_a x_a@f$ at each local place. */
    std::vector<Vector>
    interpolate(const GridSpace<dim>      &space,
                const std::vector<Vector> &nodal) const;

    /** @f$\int N_a t\,d\Gamma@f$, summed over ranks. Collective. */
    LA::Vector
    integrate(const GridSpace<dim>      &space,
              const std::vector<Vector> &tractions) const;

    /** Add the rigid field whose resultant and moment are those of the forces
     * @p missing. Collective. */
    void
    add_rigid_field(const GridSpace<dim> &space,
                    const LA::Vector     &missing,
                    std::vector<Vector>  &tractions) const;

    AbsorbingBoundary<dim> &boundary;
    const bool              acts;
    std::vector<LocalPlace> local_places; ///< by cell, if it acts
    std::vector<double>     shapes;       ///< of nodes of cells, by place
    BoundaryReport<dim>     prepared;
  };
} // namespace moraine

#endif
