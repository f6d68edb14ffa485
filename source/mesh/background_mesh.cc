// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/background_mesh.h>

#include <moraine/core/archive_components.h>
#include <moraine/core/exceptions.h>
#include <moraine/mesh/make_mesh.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  BackgroundMesh<dim>::BackgroundMesh(const MeshParameters<dim> &parameters,
                                      const MPI_Comm            &communicator)
    : tria(communicator,
           Triangulation<dim>::none,
           false,
           parallel::shared::Triangulation<dim>::partition_custom_signal)
    , cache(tria, cell_mapping)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      tria.signals.create.connect([this]() {
        order_cells();
        cut_curve([](const CellIterator &) { return 1.; });
      });
    if (!parameters.is_box())
      {
        Triangulation<dim> cells;
        sides = make_mesh(parameters, cells);
        tria.copy_triangulation(cells);
        measure_cells();
        return;
      }

    const auto n = parameters.n_cells();
    require_memory_for_cells<dim>(
      std::accumulate(n.begin(), n.end(), 1., std::multiplies<double>()),
      place("Mesh", parameters.cells.empty() ? "Cell size" : "Cells"));
    GridGenerator::subdivided_hyper_rectangle(
      tria,
      std::vector<unsigned int>(n.begin(), n.end()),
      parameters.lower_corner,
      parameters.upper_corner,
      true);
    for (const std::string name : {"left",
                                   "right",
                                   dim == 2 ? "bottom" : "front",
                                   dim == 2 ? "top" : "back"})
      sides.names.emplace_back(name, sides.names.size());
    if (dim == 3)
      {
        sides.names.emplace_back("bottom", 4);
        sides.names.emplace_back("top", 5);
      }

    cells_of_box = n;
    BoxGrid<dim> grid;
    grid.lower_corner = parameters.lower_corner;
    grid.n_cells      = n;
    for (unsigned int d = 0; d < dim; ++d)
      {
        grid.cell_size[d] =
          (parameters.upper_corner[d] - parameters.lower_corner[d]) / n[d];
        largest_edge       = std::max(largest_edge, grid.cell_size[d]);
        largest_coordinate = std::max({largest_coordinate,
                                       std::abs(parameters.lower_corner[d]),
                                       std::abs(parameters.upper_corner[d])});
      }
    box = grid;
  }



  template <int dim>
  void
  BackgroundMesh<dim>::order_cells()
  {
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(tria.get_communicator());
    if (tria.n_active_cells() < n_ranks)
      throw InputError("section 'Mesh': found a mesh of " +
                       std::to_string(tria.n_active_cells()) + " cell(s) on " +
                       std::to_string(n_ranks) +
                       " ranks, allowed: at least one for each of them");
    // As many parts as cells give every cell its place on the Z-curve.
    curve.resize(tria.n_active_cells());
    GridTools::partition_triangulation_zorder(curve.size(), tria, false);
    for (const auto &cell : tria.active_cell_iterators())
      curve[cell->subdomain_id()] = cell;
  }



  template <int dim>
  void
  BackgroundMesh<dim>::cut_curve(
    const std::function<double(const CellIterator &)> &work)
  {
    // Work up to the middle of each cell, which decides whose it is.
    std::vector<double> until_middle;
    double              total = 0;
    for (const auto &cell : curve)
      {
        const double of_cell = work(cell);
        until_middle.push_back(total + 0.5 * of_cell);
        total += of_cell;
      }
    Assert(total > 0, ExcInternalError());
    const unsigned int n_parts =
      Utilities::MPI::n_mpi_processes(tria.get_communicator());
    // No part is without cells: its rank would wait for others for ever.
    int part = -1;
    for (int i = 0, n = curve.size(); i < n; ++i)
      {
        const int of_work = n_parts * until_middle[i] / total;
        const int least   = std::max(part, int(n_parts) - (n - i));
        part              = std::min(std::max(of_work, least), part + 1);
        curve[i]->set_subdomain_id(part);
      }
  }



  template <int dim>
  void
  BackgroundMesh<dim>::share_cells(
    const std::function<double(const CellIterator &)> &work)
  {
    if (curve.empty())
      return;
    cut_curve(work);
    // Nothing is refined; this makes the triangulation see who owns what.
    tria.execute_coarsening_and_refinement();
  }



  template <int dim>
  void
  BackgroundMesh<dim>::measure_cells()
  {
    largest_edge       = 0;
    largest_coordinate = 0;
    for (const Point<dim> &x : tria.get_vertices())
      for (unsigned int d = 0; d < dim; ++d)
        largest_coordinate = std::max(largest_coordinate, std::abs(x[d]));
    for (const auto &cell : tria.active_cell_iterators())
      for (unsigned int line = 0; line < cell->n_lines(); ++line)
        largest_edge = std::max(largest_edge,
                                cell->line(line)->vertex(0).distance(
                                  cell->line(line)->vertex(1)));
  }



  namespace
  {
    /** The box whose vertices went to @p vertices, if it is one still. */
    template <int dim>
    std::optional<BoxGrid<dim>>
    moved_box(const BoxGrid<dim>                                  &box,
              const std::vector<Point<dim>>                       &places,
              const std::vector<Point<dim>>                       &vertices,
              const std::function<Point<dim>(const Point<dim> &)> &motion)
    {
      Point<dim> upper = box.lower_corner;
      for (unsigned int d = 0; d < dim; ++d)
        upper[d] += box.n_cells[d] * box.cell_size[d];
      BoxGrid<dim> moved = box;
      moved.lower_corner = motion(box.lower_corner);
      upper              = motion(upper);
      // Of a motion: a sum of products, and their differences.
      constexpr double round_off = 32. * std::numeric_limits<double>::epsilon();
      Tensor<1, dim>   stretch;
      for (unsigned int d = 0; d < dim; ++d)
        {
          moved.cell_size[d] =
            (upper[d] - moved.lower_corner[d]) / box.n_cells[d];
          stretch[d] = moved.cell_size[d] / box.cell_size[d];
        }
      for (unsigned int v = 0; v < places.size(); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          if (std::abs(moved.lower_corner[d] +
                       stretch[d] * (places[v][d] - box.lower_corner[d]) -
                       vertices[v][d]) >
              std::max(1e-12 * moved.cell_size[d] * moved.n_cells[d],
                       round_off * vertices[v].norm()))
            return {};
      return moved;
    }
  } // namespace



  template <int dim>
  std::vector<Point<dim>>
  BackgroundMesh<dim>::moved_vertices(
    const std::function<Point<dim>(const Point<dim> &)> &motion) const
  {
    std::vector<Point<dim>> vertices = tria.get_vertices();
    for (Point<dim> &x : vertices)
      x = motion(x);
    const auto inverted = find_inverted_cell<dim>(tria, vertices);
    if (inverted)
      {
        std::ostringstream message;
        message << std::setprecision(10)
                << "a motion of the mesh turns the cell at (" << *inverted
                << ") inside out";
        throw ComputationError(message.str());
      }
    return vertices;
  }



  template <int dim>
  void
  BackgroundMesh<dim>::move_vertices(
    const std::function<Point<dim>(const Point<dim> &)> &motion)
  {
    const std::vector<Point<dim>> vertices = moved_vertices(motion);
    keep_built_vertices();
    if (box)
      box = moved_box<dim>(*box, tria.get_vertices(), vertices, motion);
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        cell->vertex(v) = vertices[cell->vertex_index(v)];
    measure_cells();
    // Renews the search caches, ours and that of the points; unknowns and
    // points do not listen to it.
    tria.signals.mesh_movement();
  }



  template <int dim>
  std::optional<
    std::pair<typename BackgroundMesh<dim>::CellIterator, Point<dim>>>
  BackgroundMesh<dim>::cell_around(const Point<dim> &x) const
  {
    namespace bgi              = boost::geometry::index;
    constexpr double tolerance = 1e-10;
    BoundingBox<dim> around(std::make_pair(x, x));
    around.extend(tolerance * largest_edge);
    std::optional<std::pair<CellIterator, Point<dim>>> found;
    for (const auto &[box, cell] :
         cache.get_cell_bounding_boxes_rtree() |
           bgi::adaptors::queried(bgi::intersects(around)))
      {
        Point<dim> xi;
        cell_mapping.transform_points_real_to_unit_cell(
          cell,
          ArrayView<const Point<dim>>(&x, 1),
          ArrayView<Point<dim>>(&xi, 1));
        if (GeometryInfo<dim>::distance_to_unit_cell(xi) < tolerance &&
            (!found ||
             cell->active_cell_index() < found->first->active_cell_index()))
          found.emplace(cell, xi);
      }
    return found;
  }



  template <int dim>
  void
  BackgroundMesh<dim>::write(Archive &archive) const
  {
    archive.write("mesh/vertex_position",
                  components_of(tria.get_vertices()),
                  dim,
                  "length");
    std::vector<double> grid;
    if (box)
      {
        grid.assign(box->lower_corner.begin_raw(), box->lower_corner.end_raw());
        grid.insert(grid.end(),
                    box->cell_size.begin_raw(),
                    box->cell_size.end_raw());
      }
    archive.write("mesh/box_corner_and_cell_size",
                  std::move(grid),
                  dim,
                  "length");
  }



  template <int dim>
  void
  BackgroundMesh<dim>::read(const Archive &archive)
  {
    const auto &places = archive.numbers("mesh/vertex_position", dim);
    AssertThrow(places.size() == dim * tria.n_vertices(),
                ExcMessage("The archive is of another mesh."));
    keep_built_vertices();
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        std::copy_n(places.begin() + dim * cell->vertex_index(v),
                    dim,
                    cell->vertex(v).begin_raw());
    const auto &grid = archive.numbers("mesh/box_corner_and_cell_size", dim);
    if (grid.empty())
      box.reset();
    else
      {
        box.emplace().n_cells = cells_of_box;
        std::copy_n(grid.begin(), dim, box->lower_corner.begin_raw());
        std::copy_n(grid.begin() + dim, dim, box->cell_size.begin_raw());
      }
    measure_cells();
    tria.signals.mesh_movement();
  }



  template class BackgroundMesh<2>;
  template class BackgroundMesh<3>;
} // namespace moraine
