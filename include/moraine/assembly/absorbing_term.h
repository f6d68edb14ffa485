// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_absorbing_term_h
#define moraine_assembly_absorbing_term_h

#include <moraine/assembly/term.h>
#include <moraine/boundary/implicit_boundary.h>

#include <utility>

namespace moraine
{
  /**
   * An implicit boundary that swallows waves (Lysmer and Kuhlemeyer 1969; with
   * springs Deeks and Randolph 1994), with the material beside it:
   *
   * @f[ t = -\rho\, (c_p\, n \otimes n + c_s (1 - n \otimes n))\, v
   *       - \Bigl(\frac{2 G}{r_b} n \otimes n
   *       + \frac{G}{2 r_b} (1 - n \otimes n)\Bigr) u , @f]
   *
   * u being the displacement of the place since the start. Phuong et al. 2023,
   * eqs. (9) to (16), where the square root must cover all of
   * @f$E(1-\nu)/(\rho(1+\nu)(1-2\nu))@f$ and the sign of (15) is that of
   * (12).
   */
  template <int dim>
  class AbsorbingTerm : public Term<dim>
  {
  public:
    explicit AbsorbingTerm(ImplicitBoundary<dim> &boundary);

    WorkKind
    work_kind() const override
    {
      return WorkKind::absorbed;
    }

    std::vector<Effect>
    effects(const StepContext<dim> &context) const override;

    std::string
    timer() const override
    {
      return "boundary pieces";
    }

    bool
    begin_step(const StepContext<dim> &context) override;

    void
    begin_trial(const StepContext<dim> &context) override;

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

  private:
    using Matrix = dealii::SymmetricTensor<2, dim>;

    /** Dashpots and springs per area at the q-th point. */
    std::pair<Matrix, Matrix>
    impedance(const StepContext<dim> &context, const unsigned int q) const;

    ImplicitBoundary<dim> &boundary;
    BoundaryReport<dim>    prepared;
  };
} // namespace moraine

#endif
