// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/schwarz_preconditioner.h>

#include <moraine/core/silent_errors.h>

#include <deal.II/base/mpi.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Ifpack.h>
#include <Teuchos_ParameterList.hpp>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Layers of the matrix's graph around a subdomain. Fewer cost less each
     * and let the number of iterations grow as Poisson's ratio goes to 0.5. */
    constexpr int
    layers_around(const unsigned int dim)
    {
      return dim == 2 ? 5 : 4;
    }
  } // namespace



  SchwarzPreconditioner::SchwarzPreconditioner(const LA::SparseMatrix &matrix,
                                               const unsigned int      dim)
  {
    const SilentErrors silence;
    auto *A = const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix());
    Teuchos::RCP<Ifpack_Preconditioner> schwarz(
      Ifpack().Create("Amesos", A, layers_around(dim)));
    Teuchos::ParameterList options;
    options.set("schwarz: combine mode", "Add"); // symmetric
    options.set("schwarz: compute condest", false);
    options.set("amesos: solver type",
                Amesos().Query("Amesos_Mumps") ? "Amesos_Mumps" :
                                                 "Amesos_Umfpack");
    const bool failed = schwarz->SetParameters(options) != 0 ||
                        schwarz->Initialize() != 0 || schwarz->Compute() != 0;
    if (!Utilities::MPI::logical_or(failed, matrix.get_mpi_communicator()))
      preconditioner = schwarz;
  }



  void
  SchwarzPreconditioner::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    if (preconditioner.is_null())
      dst = src;
    else
      PreconditionBase::vmult(dst, src);
  }
} // namespace moraine
