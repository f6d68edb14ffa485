// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_assembly_shared_nodes_h
#define moraine_assembly_shared_nodes_h

#include <moraine/assembly/boundary_report.h>
#include <moraine/assembly/step_context.h>
#include <moraine/boundary/grid_condition.h>

#include <map>
#include <utility>
#include <vector>

namespace moraine
{
  /** Where a force on a node has its moment: where forces balance. */
  template <int dim>
  dealii::Point<dim>
  place_in_balance(const StepContext<dim> &context, const unsigned int node);

  /** See BoundaryReport::moment. */
  template <int dim>
  double
  moment_on_nodes(const GridCondition<dim>     &condition,
                  const StepContext<dim>       &context,
                  const dealii::Point<dim>     &x,
                  const dealii::Tensor<1, dim> &force);

  /**
   * Forces of unknowns that several grid conditions prescribe, as where a wall
   * and a base meet. Only their sum r is known. It is shared out by the stress
   * beside the faces of each,
   * @f[ r_c = t_c + \Big(r - \sum_d t_d\Big)
   *                 \frac{|t_c|}{\sum_d |t_d|},
   *     \qquad t_c = \sum_{f \in c} w_f\, A_f\, e_i \cdot \bar\sigma_f n_f ,
   * @f] over the faces of the mesh's boundary all of whose nodes c prescribes,
   * with the area A, the normal n, the mean stress of the points of the cell,
   * and the share w of the node by the rule of Gauss and Lobatto. Without such
   * a face the first condition has all. For reports alone.
   */
  template <int dim>
  class SharedNodes
  {
  public:
    SharedNodes() = default;

    /** Collective. */
    SharedNodes(const PrescribedNodes<dim> &prescribed,
                const unsigned int          n_conditions,
                const GridSpace<dim>       &space);

    /** Keep the sums: @p factor times what is @p unbalanced in the step of @p
     * context. */
    void
    keep(const StepContext<dim> &context,
         const LA::Vector       &unbalanced,
         const double            factor);

    /** Change @p reports, one for each condition, in which the first of several
     * has the sum. Collective. */
    void
    share_out(const StepContext<dim>                &context,
              const std::vector<GridCondition<dim>> &conditions,
              std::vector<BoundaryReport<dim>>      &reports) const;

  private:
    struct Unknown
    {
      unsigned int              node;
      unsigned int              component;
      std::vector<unsigned int> conditions;
      double                    force = 0; ///< if this rank owns it
      dealii::Point<dim>        x;         ///< see place_in_balance()
    };

    /** A face on which @p condition prescribes @p component of all nodes. */
    struct Face
    {
      unsigned int              cell;
      unsigned int              condition;
      unsigned int              component;
      std::vector<unsigned int> nodes;
      std::vector<unsigned int>
        corners; ///< lexicographic, as those of the cell
      std::vector<unsigned int>                    corners_of_cell;
      std::vector<std::pair<unsigned int, double>> shares; ///< nodes, w
    };

    using Cell = typename GridSpace<dim>::CellIterator;

    void
    find_faces(const std::vector<std::vector<bool>> &prescribes,
               const GridSpace<dim>                 &space);

    /** Face @p f of @p cell with the nodes whose @p component is_shared. */
    static Face
    face_of(const Cell              &cell,
            const unsigned int       f,
            const unsigned int       component,
            const std::vector<bool> &is_shared,
            const GridSpace<dim>    &space);

    /** t_c of the unknowns, by node's first unknown plus component, and by
     * condition; the same on all ranks. Collective. */
    std::map<std::pair<dealii::types::global_dof_index, unsigned int>, double>
    tractions(const StepContext<dim> &context) const;

    bool                 any = false; ///< on some rank
    std::vector<Unknown> unknowns;
    std::vector<Face>    faces;
  };
} // namespace moraine

#endif
