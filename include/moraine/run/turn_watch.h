// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_run_turn_watch_h
#define moraine_run_turn_watch_h

#include <moraine/assembly/boundary_report.h>
#include <moraine/run/model.h>

#include <map>
#include <string>
#include <vector>

namespace moraine
{
  /**
   * Looks how much strain small strain finds in a turn without any. A
   * boundary or grid condition with a 'Rotation angle' prescribes
   * @f$(R - 1)\,x@f$, whose symmetric part is @f$(\cos\theta - 1)\,1@f$ across
   * the axis: a strain of @f$\theta^2/2@f$, of the turn of each step where
   * points move, else of all. What turns freely does not have it.
   */
  template <int dim>
  class TurnWatch : public StatePart
  {
  public:
    TurnWatch(const Scene<dim> &scene, const Model<dim> &model);

    /**
     * After a step to @p t, in which what @p reports name held: what is to be
     * told, once, when that strain exceeds a fifth of the largest one that
     * elastic stress stands for, in the norm of energy: where volume is kept
     * the bulk modulus meets it; or "". Collective.
     */
    std::string
    look(const double t, const std::vector<BoundaryReport<dim>> &reports);

    /** Data sets "checks/turns/...". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

  private:
    /** What a motion has made so far. */
    struct Turn
    {
      double since;      ///< when it began
      double strain = 0; ///< that is none
    };

    /** The largest strain @f$e@f$ of a turn, @f$e\,1@f$ across its axis, that
     * would have the energy of the stress of a point: @f$4(\lambda + \mu) e^2 =
     * \sigma : C^{-1} : \sigma@f$. */
    double
    largest_strain_by_energy() const;

    const Model<dim>           &model;
    double                      last; ///< end of the step before
    std::map<std::string, Turn> turns;
    bool                        told = false;
  };
} // namespace moraine

#endif
