// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_boundary_report_h
#define moraine_assembly_boundary_report_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <optional>
#include <string>

namespace moraine
{
  /** Of a surface that bodies touch. */
  struct ContactReport
  {
    double area             = 0; ///< of the rims in contact
    double slipping_area    = 0; ///< the part of it that slides
    double slip             = 0; ///< longest path along the surface so far
    double work_of_friction = 0; ///< so far, on the body
  };

  /** Reaction force and worst violation of a boundary in an accepted step. */
  template <int dim>
  struct BoundaryReport
  {
    std::string            name;
    dealii::Tensor<1, dim> reaction;    ///< force on the body
    double                 violation;   ///< largest |M(u - g)| of the step
    double                 penetration; ///< largest depth of a point behind it
    /** Moment on the body about the axis its motion turns about, else about the
     * origin; in 3D the component along the axis. Places and axis are those in
     * which forces balance, see StepContext::balances_at_end(). */
    double moment;
    /** @f$\int |t|\,d\Gamma@f$ or @f$\sum_a |f_a|@f$, without cancellation;
     * see BoundaryTerm::force_magnitude(). */
    double force_magnitude;
    /** Of these forces in the motion that is prescribed in the step; of nodes
     * Works::of_prescribed has it. */
    double work_of_motion = 0;
    /** If it is one of contact. */
    std::optional<ContactReport> contact = {};
  };

  /** Add up what the ranks know of the forces of a boundary. */
  template <int dim>
  void
  sum_over_ranks(BoundaryReport<dim> &report, const MPI_Comm &communicator)
  {
    namespace MPI          = dealii::Utilities::MPI;
    report.reaction        = MPI::sum(report.reaction, communicator);
    report.moment          = MPI::sum(report.moment, communicator);
    report.force_magnitude = MPI::sum(report.force_magnitude, communicator);
    report.work_of_motion  = MPI::sum(report.work_of_motion, communicator);
  }
} // namespace moraine

#endif
