// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/implicit_boundary.h>

#include <moraine/mesh/active_search.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Segments are cut exactly; this many points integrate products of Q2. On a
     * line through a quadrilateral that is no parallelogram functions are no
     * polynomials; there twice as many are exact to about round-off.
     */
    constexpr unsigned int n_gauss_points = 4;



    template <int dim>
    unsigned int
    n_gauss_points_in(const CellVertices<dim> &cell)
    {
      const bool is_skewed =
        dim == 2 && (cell[0] - cell[1] - (cell[2] - cell[3])).norm() >
                      1e-12 * cell[0].distance(cell[3]);
      return is_skewed ? 2 * n_gauss_points : n_gauss_points;
    }



    /** The vertices of an active cell where its nodes are now. */
    template <int dim>
    CellVertices<dim>
    present_vertices(const GridSpace<dim> &space, const unsigned int cell)
    {
      const unsigned int *nodes = space.cell_nodes(cell);
      const unsigned int  k     = space.degree();
      CellVertices<dim>   vertices;
      for (unsigned int v = 0; v < vertices.size(); ++v)
        {
          unsigned int node = 0, stride = 1;
          for (unsigned int d = 0; d < dim; ++d, stride *= k + 1)
            node += ((v >> d) & 1) * k * stride;
          vertices[v] = space.node_position(nodes[node]);
        }
      return vertices;
    }



    template <int dim>
    BoundingBox<dim>
    box_of(const CellVertices<dim> &vertices)
    {
      return BoundingBox<dim>(
        std::vector<Point<dim>>(vertices.begin(), vertices.end()));
    }



    template <int dim>
    bool
    overlap(const BoundingBox<dim> &a,
            const BoundingBox<dim> &b,
            const double            by)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (a.lower_bound(d) > b.upper_bound(d) + by ||
            b.lower_bound(d) > a.upper_bound(d) + by)
          return false;
      return true;
    }
  } // namespace



  template <int dim>
  SymmetricTensor<2, dim>
  Constraint<dim>::projection(const Tensor<1, dim> &normal) const
  {
    SymmetricTensor<2, dim> M;
    if (kind == roller)
      M = symmetrize(outer_product(normal, normal));
    else
      for (unsigned int d = 0; d < dim; ++d)
        M[d][d] = (kind == fixed || component[d]) ? 1. : 0.;
    return M;
  }



  template <int dim>
  ImplicitBoundary<dim>::ImplicitBoundary(
    const std::string                  &name,
    std::shared_ptr<const Surface<dim>> surface,
    const RigidMotion<dim>             &motion,
    const Displacement                 &displacement,
    const Constraint<dim>              &constraint,
    const Enforcement                  &enforcement,
    const double                        penetration_limit)
    : boundary_name(name)
    , at_start(surface)
    , at_end(surface)
    , motion(motion)
    , displacement(displacement)
    , constraint(constraint)
    , how(enforcement)
    , limit(penetration_limit)
  {}



  template <int dim>
  void
  ImplicitBoundary<dim>::begin_step(const GridSpace<dim> &space,
                                    const double          t,
                                    const double          reach,
                                    const bool            moves_points,
                                    const StrainMeasure   measure,
                                    const bool            cells_changed)
  {
    t_start           = t;
    moves_with_points = moves_points;
    turns_reaction    = moves_points && measure == StrainMeasure::finite &&
                     constraint.kind == Constraint<dim>::fixed;
    lands = moves_points && at_start.curved() &&
            constraint.kind == Constraint<dim>::roller;
    const bool moves = moves_points && motion.moves();
    if (placed && !cells_changed && !moves)
      return;
    const Pose<dim> previous_pose = at_start.pose();
    if (!placed || moves)
      at_start.set_pose(motion.pose(t));
    std::vector<BoundaryPoint<dim>> previous;
    std::swap(previous, boundary_points);
    find_pieces(space, reach);
    evaluate_shapes(space);
    if (placed)
      take_over(previous, previous_pose, space.communicator());
    placed = true;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::find_pieces(const GridSpace<dim> &space,
                                     const double          reach)
  {
    const BoundingBox<dim> surface_box = at_start.bounding_box();
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      {
        const bool own_active =
          cell->is_locally_owned() && space.is_active(cell);
        if (!own_active && space.is_active(cell))
          continue;
        const CellVertices<dim> vertices =
          own_active ? present_vertices(space, cell->active_cell_index()) :
                       vertices_of<dim>(cell);
        if (overlap(box_of<dim>(vertices),
                    surface_box,
                    1e-9 * cell->diameter()))
          add_pieces(space, cell, vertices, reach);
      }
    std::stable_sort(boundary_points.begin(),
                     boundary_points.end(),
                     [](const auto &a, const auto &b) {
                       return a.cell < b.cell;
                     });
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::add_pieces(
    const GridSpace<dim>                        &space,
    const typename GridSpace<dim>::CellIterator &cell,
    const CellVertices<dim>                     &vertices,
    const double                                 reach)
  {
    std::vector<SurfacePoint<dim>> pieces;
    // The mesh as it was built decides, so that the points stay the same ones.
    at_start.pieces(vertices,
                    n_gauss_points_in<dim>(vertices_of<dim>(cell)),
                    pieces);
    for (const SurfacePoint<dim> &piece : pieces)
      {
        const auto owner = nearest_active_cell(space, cell, piece.x, reach);
        if (owner.state() != IteratorState::valid || !owner->is_locally_owned())
          continue;
        BoundaryPoint<dim> point;
        point.x      = piece.x;
        point.normal = piece.normal;
        point.JxW    = piece.JxW;
        point.cell   = owner->active_cell_index();
        point.h      = std::pow(owner->measure(), 1. / dim);
        boundary_points.push_back(point);
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::evaluate_shapes(const GridSpace<dim> &space)
  {
    n_nodes = space.nodes_per_cell();
    values.resize(boundary_points.size() * n_nodes);
    gradients.resize(boundary_points.size() * n_nodes);
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        const auto &point = boundary_points[q];
        moraine::evaluate_shapes(space,
                                 point.cell,
                                 point.x,
                                 &values[q * n_nodes],
                                 &gradients[q * n_nodes]);
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::take_over(
    const std::vector<BoundaryPoint<dim>> &previous,
    const Pose<dim>                       &previous_pose,
    const MPI_Comm                        &communicator)
  {
    const Pose<dim> &pose = at_start.pose();

    // Of all ranks, because a moving surface takes its points from rank to
    // rank. What a roller carries goes along with its normal.
    const Tensor<2, dim> turn =
      constraint.kind == Constraint<dim>::roller ?
        pose.rotation() * transpose(previous_pose.rotation()) :
        Tensor<2, dim>(unit_symmetric_tensor<dim>());
    std::vector<std::array<Tensor<1, dim>, 3>> carried;
    for (const auto &point : previous)
      carried.push_back({{Tensor<1, dim>(previous_pose.inverse(point.x)),
                          turn * point.committed_reaction,
                          turn * point.gap}});
    const auto everyones = Utilities::MPI::all_gather(communicator, carried);

    std::vector<Point<dim>>                    places;
    std::vector<std::array<Tensor<1, dim>, 3>> all;
    for (const auto &of_one_rank : everyones)
      for (const auto &entry : of_one_rank)
        {
          places.emplace_back(entry[0]);
          all.push_back(entry);
        }
    if (all.empty())
      return;
    const auto tree = pack_rtree_of_indices(places);
    for (auto &point : boundary_points)
      {
        const Point<dim> place = pose.inverse(point.x);
        for (auto it = tree.qbegin(boost::geometry::index::nearest(place, 1));
             it != tree.qend();
             ++it)
          {
            point.committed_reaction = all[*it][1];
            point.gap                = all[*it][2];
          }
      }
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::set_target(const double t_end)
  {
    const Pose<dim> start = motion.pose(t_start), end = motion.pose(t_end);
    at_end.set_pose(moves_with_points ? end : at_start.pose());
    const Tensor<2, dim> turn = turns_reaction ?
                                  end.rotation() * transpose(start.rotation()) :
                                  Tensor<2, dim>(unit_symmetric_tensor<dim>());
    for (auto &point : boundary_points)
      {
        const Point<dim> X = at_start.pose().inverse(point.x);
        point.prescribed   = (end.map(X) - start.map(X)) +
                           displacement(point.x, t_end) -
                           displacement(point.x, t_start);
        point.reaction = how.carries_reaction ?
                           turn * point.committed_reaction :
                           Tensor<1, dim>();
      }
  }



  template <int dim>
  ConstraintState<dim>
  ImplicitBoundary<dim>::constraint_state(const BoundaryPoint<dim> &point,
                                          const Tensor<1, dim>     &du) const
  {
    ConstraintState<dim> state;
    if (lands)
      {
        const Point<dim> landing = point.x + du;
        state.normal             = at_end.normal(landing);
        const Tensor<1, dim> relative =
          point.prescribed -
          (at_end.pose().map(at_start.pose().inverse(point.x)) - point.x);
        state.violation =
          (-at_end.level(landing) - relative * state.normal) * state.normal;
        state.M = constraint.projection(state.normal);
      }
    else
      {
        state.normal    = point.normal;
        state.M         = constraint.projection(point.normal);
        state.violation = state.M * (du - point.prescribed);
      }
    return state;
  }



  template <int dim>
  void
  ImplicitBoundary<dim>::accept(const std::vector<Tensor<1, dim>> &tractions,
                                const std::vector<Tensor<1, dim>> &violations)
  {
    if (!how.carries_reaction)
      return;
    for (unsigned int q = 0; q < boundary_points.size(); ++q)
      {
        boundary_points[q].committed_reaction = tractions[q];
        boundary_points[q].gap += violations[q];
      }
  }



  template <int dim>
  double
  ImplicitBoundary<dim>::penetration(const Point<dim> &x,
                                     const double      range) const
  {
    const double level = at_end.level(x);
    return (level < 0 && level > -range && at_end.in_extent(x)) ? -level : 0.;
  }



  template struct Constraint<2>;
  template struct Constraint<3>;
  template class ImplicitBoundary<2>;
  template class ImplicitBoundary<3>;
} // namespace moraine
