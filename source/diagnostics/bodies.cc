// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Bodies that share cells or nodes, or are thin for their cells.

#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace moraine
{
  namespace checks
  {
    using namespace dealii;

    namespace
    {
      /** A body has more of a cell of its own. */
      constexpr double least_share = 0.01, most_share = 0.5;

      /** Of the vertices of a body along the edge of the mesh: from here on the
       * conditions on them do not let it bend. */
      constexpr double held_share = 0.4;

      /** Of shear moduli: a stiff body stiffens the cells of a soft one. */
      constexpr double contrast = 10;

      /** Of two cells side by side, for a thickness of one and a half cells. */
      constexpr double least_of_pair = 1.5 - 1e-9;

      /** Of the compression of a soft body that shared cells hold back. */
      constexpr double allowed_share_of_soft = 0.05;

      /** Of a cell: a gap that is meant. */
      constexpr double least_gap = 0.25;

      /** Of a cell: an overlap; bodies that are nearer may share nodes. */
      constexpr double allowed_overlap = 0.1, apart = 2.1;



      /** Vertices of cells that a boundary or a condition holds; the same on
       * all ranks. */
      template <int dim>
      std::vector<double>
      held_vertices(const Facts<dim> &facts)
      {
        const auto         &tria = facts.of.mesh.triangulation();
        std::vector<double> held(tria.n_vertices(), 0.);
        for (const auto &entry :
             find_prescribed_nodes(acting_conditions(facts.of.grid_conditions,
                                                     *facts.now.stage),
                                   facts.of.space,
                                   facts.now.t)
               .entries)
          for (const unsigned int v : facts.of.space.node_vertices(entry.node))
            held[v] = 1;
        std::vector<bool> holds(tria.n_active_cells(), false);
        for (const auto &boundary : facts.of.boundaries)
          if (contains(facts.now.stage->boundaries, boundary.name()))
            for (const auto &point : boundary.points())
              holds[point.cell] = true;
        for (const auto &cell : tria.active_cell_iterators())
          if (holds[cell->active_cell_index()])
            for (const unsigned int a : cell->vertex_indices())
              held[cell->vertex_index(a)] = 1;
        Utilities::MPI::max(held, facts.communicator(), held);
        return held;
      }



      /** Vertices at which the filled @p parts of cells are thick: all but a
       * quarter of the cells around is filled, or cell and neighbours are in
       * each direction. */
      template <int dim>
      std::vector<bool>
      thick_vertices(const Facts<dim> &facts, const std::vector<double> &parts)
      {
        std::vector<bool> thick = vertices_in_bulk(facts.of.space, parts);
        for (const auto &cell :
             facts.of.mesh.triangulation().active_cell_iterators())
          if (const double part = parts[cell->active_cell_index()];
              part > most_share)
            for (const unsigned int v : cell->vertex_indices())
              {
                const auto &faces = GeometryInfo<dim>::vertex_to_face[v];
                if (all_of(faces, [&](const unsigned int f) {
                      return cell->at_boundary(f) ||
                             part + parts[cell->neighbor(f)
                                            ->active_cell_index()] >=
                               least_of_pair;
                    }))
                  thick[cell->vertex_index(v)] = true;
              }
        return thick;
      }



      /** Whether a body that fills @p parts of the cells is nowhere thicker
       * than one and a half cells, hardly held, and no other body (@p
       * all_thick) supports it. */
      template <int dim>
      bool
      is_thin(const Facts<dim>          &facts,
              const std::vector<double> &parts,
              const std::vector<bool>   &all_thick,
              const std::vector<double> &held)
      {
        const std::vector<bool> thick = thick_vertices(facts, parts);
        std::vector<bool>       at_edge(thick.size(), false), is_its = at_edge;
        for (const auto &cell :
             facts.of.mesh.triangulation().active_cell_iterators())
          {
            if (parts[cell->active_cell_index()] > most_share)
              for (const unsigned int a : cell->vertex_indices())
                is_its[cell->vertex_index(a)] = true;
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary())
                for (unsigned int a = 0; a < face->n_vertices(); ++a)
                  at_edge[face->vertex_index(a)] = true;
          }
        unsigned int n = 0, n_held = 0;
        bool         supported = false;
        for (unsigned int v = 0; v < thick.size(); ++v)
          {
            supported = supported || (is_its[v] && all_thick[v] && !at_edge[v]);
            if (!thick[v])
              continue;
            if (!at_edge[v])
              return false;
            ++n;
            n_held += held[v] > 0;
          }
        return n == 0 || (n_held < held_share * n && !supported);
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    thin_bodies(Facts<dim> &facts, Ledger &)
    {
      if (facts.of.space.degree() != 1)
        return {};
      const auto         &parts = facts.filled_parts();
      std::vector<double> all(parts[0].size(), 0.);
      for (const auto &of_body : parts)
        for (unsigned int c = 0; c < all.size(); ++c)
          all[c] += of_body[c];
      const std::vector<bool>   all_thick = thick_vertices(facts, all);
      const std::vector<double> held      = held_vertices(facts);
      for (unsigned int b = 0; b < parts.size(); ++b)
        if (facts.of.present[b] && facts.is_new(facts.of.body_names[b]) &&
            is_thin(facts, parts[b], all_thick, held))
          return Finding{"thin-body",
                         facts.of.body_names[b],
                         1,
                         1.5,
                         "it is thinner than one and a half cells and bends "
                         "much too stiffly; take smaller cells, or finite "
                         "elements with 'Degree = 2'"};
      return {};
    }



    namespace
    {
      /** What cells of both hold back of the compression of a soft body, over
       * all of it: layers in a row give way by the mean of their compliances,
       * the one displacement of a cell by that of their stiffnesses.
       * @param ratio of the stiffnesses
       * @param volumes of cells */
      double
      share_held_back(const std::vector<double> &stiff,
                      const std::vector<double> &soft,
                      const double               ratio,
                      const std::vector<double> &volumes)
      {
        double held = 0, all = 0;
        for (unsigned int c = 0; c < stiff.size(); ++c)
          {
            all += soft[c] * volumes[c];
            if (!(stiff[c] > least_share) || !(soft[c] > 0))
              continue;
            const double both = soft[c] + stiff[c];
            held += volumes[c] * (soft[c] + stiff[c] / ratio -
                                  both * both / (soft[c] + ratio * stiff[c]));
          }
        return held / all;
      }



      /** Cells of which the stiff body has less than half beside the soft one:
       * these become as stiff, or its stress there as large, as with a sliver.
       */
      unsigned int
      n_shared(const std::vector<double> &stiff,
               const std::vector<double> &soft)
      {
        unsigned int n = 0;
        for (unsigned int c = 0; c < stiff.size(); ++c)
          n += stiff[c] > 0 && stiff[c] < most_share && soft[c] > least_share;
        return n;
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    shared_cells(Facts<dim> &facts, Ledger &)
    {
      const auto         &parts = facts.filled_parts();
      std::vector<double> volumes;
      for (const auto &cell :
           facts.of.mesh.triangulation().active_cell_iterators())
        volumes.push_back(volume_of_cell(cell));
      const auto modulus = [&facts](const unsigned int body) {
        return facts.of.materials[body]->elastic_stiffness().mu;
      };
      const auto &names = facts.of.body_names;
      for (unsigned int b = 0; b < parts.size(); ++b)
        for (unsigned int a = 0; a < parts.size(); ++a)
          {
            const double ratio = modulus(b) / modulus(a);
            if (!facts.of.present[a] || !facts.of.present[b] ||
                !(facts.is_new(names[a]) || facts.is_new(names[b])) ||
                !(ratio > 1))
              continue;
            const double share =
              share_held_back(parts[b], parts[a], ratio, volumes);
            const unsigned int n =
              ratio > contrast ? n_shared(parts[b], parts[a]) : 0;
            if (n > 0 || share > allowed_share_of_soft)
              return Finding{
                "shared-cells",
                names[b],
                share,
                allowed_share_of_soft,
                (n > 0 ? std::to_string(n) + " cells" : std::string("cells")) +
                  " that it shares with '" + names[a] +
                  "' become as stiff as it is; end it on mesh lines, or take "
                  "smaller cells"};
          }
      return {};
    }



    namespace
    {
      /** Of each body, the points that touch nodes of another: place and half
       * of the size, of all ranks. */
      template <int dim>
      std::vector<std::pair<Point<dim>, double>>
      points_at_nodes_of(Facts<dim>        &facts,
                         const unsigned int a,
                         const unsigned int b)
      {
        const auto       &touched = facts.touched_nodes();
        StencilBlock<dim> block;
        std::vector<std::pair<Point<dim>, double>> found;
        for (unsigned int g = 0; g < facts.of.basis.n_batches(); ++g)
          {
            facts.of.basis.evaluate(g, block);
            if (std::none_of(block.nodes,
                             block.nodes + block.n_nodes,
                             [&](const unsigned int node) {
                               return touched[b][node];
                             }))
              continue;
            for (unsigned int k = 0; k < block.n_points; ++k)
              if (const unsigned int p = block.points[k];
                  facts.of.points.body(p) == a)
                found.emplace_back(facts.of.points.position(p),
                                   0.5 * std::pow(facts.of.points.volume(p),
                                                  1. / dim));
          }
        std::vector<std::pair<Point<dim>, double>> all;
        for (const auto &of_rank :
             Utilities::MPI::all_gather(facts.communicator(), found))
          all.insert(all.end(), of_rank.begin(), of_rank.end());
        return all;
      }



      /** The distance between two bodies that share nodes, by their points;
       * infinite if they do not. */
      template <int dim>
      double
      distance_between(Facts<dim>        &facts,
                       const unsigned int a,
                       const unsigned int b)
      {
        double     least = std::numeric_limits<double>::infinity();
        const auto of_a  = points_at_nodes_of(facts, a, b);
        if (of_a.empty())
          return least;
        const auto              of_b = points_at_nodes_of(facts, b, a);
        std::vector<Point<dim>> places;
        for (const auto &[x, half] : of_b)
          places.push_back(x);
        const auto tree = pack_rtree_of_indices(places);
        namespace bgi   = boost::geometry::index;
        for (const auto &[x, half] : of_a)
          for (auto it = tree.qbegin(bgi::nearest(x, 1)); it != tree.qend();
               ++it)
            {
              // Points are boxes along the axes.
              double away = 0;
              for (unsigned int d = 0; d < dim; ++d)
                away = std::max(away,
                                std::abs(x[d] - places[*it][d]) - half -
                                  of_b[*it].second);
              least = std::min(least, away);
            }
        return least;
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    near_bodies(Facts<dim> &facts, Ledger &)
    {
      const auto &names = facts.of.body_names;
      Worst       worst("bodies-meet", least_gap * facts.cell_size());
      for (unsigned int a = 0; a < names.size(); ++a)
        for (unsigned int b = a + 1; b < names.size(); ++b)
          if (facts.of.present[a] && facts.of.present[b])
            if (const double gap = distance_between(facts, a, b);
                std::isfinite(gap))
              worst.take(names[a] + " and " + names[b], gap);
      return worst.with("they are " + text_of(worst.value, 3) +
                        " apart but share nodes and stick together; take "
                        "cells smaller than half of that");
    }



    namespace
    {
      template <int dim>
      using Box = BoundingBox<dim>;

      /** The least overlap of two boxes; negative if they are apart. */
      template <int dim>
      double
      overlap(const Box<dim> &a, const Box<dim> &b)
      {
        double least = std::numeric_limits<double>::max();
        for (unsigned int d = 0; d < dim; ++d)
          least = std::min(least,
                           std::min(a.upper_bound(d), b.upper_bound(d)) -
                             std::max(a.lower_bound(d), b.lower_bound(d)));
        return least;
      }



      /** Boxes around the points of each body, at the start or now. */
      template <int dim>
      std::vector<Box<dim>>
      boxes_of_bodies(const Facts<dim> &facts, const bool moved)
      {
        const PointSet<dim> &points = facts.of.points;
        const auto           u      = points.displacement_field();
        const unsigned int   n      = facts.of.body_names.size();
        // Lower bounds, and upper ones with the other sign.
        std::vector<double> bounds(2 * dim * n,
                                   std::numeric_limits<double>::max());
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            Point<dim> x = facts.of.state.original_position(p);
            if (moved)
              x += u(points.values(p));
            double *of_body = &bounds[2 * dim * points.body(p)];
            for (unsigned int d = 0; d < dim; ++d)
              {
                of_body[d]       = std::min(of_body[d], x[d]);
                of_body[dim + d] = std::min(of_body[dim + d], -x[d]);
              }
          }
        Utilities::MPI::min(bounds, facts.communicator(), bounds);
        std::vector<Box<dim>> boxes;
        for (unsigned int b = 0; b < n; ++b)
          {
            Point<dim> lower, upper;
            for (unsigned int d = 0; d < dim; ++d)
              {
                lower[d] = bounds[2 * dim * b + d];
                upper[d] = -bounds[2 * dim * b + dim + d];
              }
            boxes.push_back(lower[0] <= upper[0] ? Box<dim>({lower, upper}) :
                                                   Box<dim>());
          }
        return boxes;
      }



      /** A body that has moved through a side of the mesh whose condition
       * holds no node; with the name of the condition. */
      template <int dim>
      std::optional<Finding>
      side_passed(const Facts<dim> &facts, const std::vector<Box<dim>> &boxes)
      {
        const BoxGrid<dim> &grid  = *facts.of.mesh.box_grid();
        const double        limit = allowed_overlap * facts.cell_size();
        for (const auto &condition :
             acting_conditions(facts.of.grid_conditions, *facts.now.stage))
          {
            if (!condition.side)
              continue;
            const auto entries =
              find_prescribed_nodes<dim>({condition},
                                         facts.of.space,
                                         facts.now.stage->time.start_time)
                .entries;
            if (Utilities::MPI::sum(entries.size(), facts.communicator()) > 0)
              continue;
            const unsigned int d        = *condition.side / 2;
            const bool         is_upper = *condition.side % 2 == 1;
            const double       side =
              grid.lower_corner[d] +
              (is_upper ? grid.n_cells[d] * grid.cell_size[d] : 0.);
            for (unsigned int b = 0; b < boxes.size(); ++b)
              if (const double out = is_upper ? boxes[b].upper_bound(d) - side :
                                                side - boxes[b].lower_bound(d);
                  facts.of.present[b] && out > limit)
                return Finding{"bodies-meet",
                               facts.of.body_names[b],
                               out,
                               limit,
                               "it has moved through '" + condition.name +
                                 "', which holds no node; use 'Method = GIMP'"};
          }
        return {};
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    bodies_meet(Facts<dim> &facts, Ledger &ledger)
    {
      const bool through_mesh =
        facts.of.state.mesh_after_step() == MeshAfterStep::reset;
      const double h     = facts.cell_size();
      const auto  &names = facts.of.body_names;
      double      &moved = ledger.number("bodies-meet/motion since asked");
      moved += facts.now.node_motion;
      if (!(moved > allowed_overlap * h) || (through_mesh && names.size() < 2))
        return {};
      moved = 0;
      if (through_mesh)
        return near_bodies(facts, ledger);
      if (facts.of.points.forgotten_displacement() > 0)
        return {};
      const auto start = boxes_of_bodies(facts, false);
      const auto boxes = boxes_of_bodies(facts, true);
      Worst      worst("bodies-meet", allowed_overlap * h);
      for (unsigned int a = 0; a < boxes.size(); ++a)
        for (unsigned int b = a + 1; b < boxes.size(); ++b)
          if (facts.of.present[a] && facts.of.present[b] &&
              overlap(start[a], start[b]) < -apart * h)
            worst.take(names[a] + " and " + names[b],
                       overlap(boxes[a], boxes[b]));
      if (const auto found = worst.with(
            "they have moved into each other, as the mesh follows them; use "
            "'Method = GIMP'"))
        return found;
      return facts.of.mesh.box_grid() ? side_passed(facts, boxes) :
                                        std::nullopt;
    }



    template <int dim>
    std::optional<Finding>
    conflicting_constraints(Facts<dim> &facts, Ledger &)
    {
      for (const Effect &effect : facts.of.system.effects())
        if (effect.kind == "note")
          return Finding{
            "conflicting-constraints", effect.name, 1, 0, effect.text};
      return {};
    }



    MORAINE_INSTANTIATE_CHECK(thin_bodies)
    MORAINE_INSTANTIATE_CHECK(shared_cells)
    MORAINE_INSTANTIATE_CHECK(near_bodies)
    MORAINE_INSTANTIATE_CHECK(bodies_meet)
    MORAINE_INSTANTIATE_CHECK(conflicting_constraints)
  } // namespace checks
} // namespace moraine
