// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/make_mesh.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/memory.h>
#include <moraine/core/words.h>
#include <moraine/mesh/cell_map.h>
#include <moraine/mesh/joined_cells.h>
#include <moraine/mesh/msh_file.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** A generator with the names of its arguments. */
    struct Generator
    {
      std::string name;
      std::string arguments;
      /** Which arguments are numbers of cells, from 0. */
      std::vector<unsigned int> counts  = {};
      bool                      only_3d = false;
    };



    /** Those that GridGenerator::generate_from_name_and_arguments() knows. */
    const std::vector<Generator> &
    all_generators()
    {
      static const std::string shell =
        "centre : inner radius : outer radius : number of cells (0: a few) : "
        "colorize";
      static const std::vector<Generator> generators{
        {"channel_with_cylinder",
         "width of the shell : number of shells : skewness : colorize",
         {1}},
        {"cheese", "numbers of holes", {0}},
        {"concentric_hyper_shells",
         "centre : inner radius : outer radius : number of shells : skewness "
         "(0: equal) : cells per shell (0: a few) : colorize",
         {3, 5}},
        {"cylinder", "radius : half length"},
        {"cylinder_shell",
         "length : inner radius : outer radius : radial cells : axial cells",
         {3, 4},
         true},
        {"eccentric_hyper_shell",
         "inner centre : outer centre : inner radius : outer radius : number "
         "of cells",
         {4}},
        {"enclosed_hyper_cube", "left : right : thickness : colorize"},
        {"general_cell", "vertices separated by ';' : colorize"},
        {"half_hyper_ball", "centre : radius"},
        {"half_hyper_shell", shell, {3}},
        {"hyper_L", "left : right : colorize"},
        {"hyper_ball", "centre : radius : spherical manifold"},
        {"hyper_ball_balanced", "centre : radius"},
        {"hyper_cross", "sizes : colorize", {0}},
        {"hyper_cube", "left : right : colorize"},
        {"hyper_cube_slit", "left : right : colorize"},
        {"hyper_cube_with_cylindrical_hole",
         "inner radius : half of the edge : length : layers : colorize",
         {3}},
        {"hyper_rectangle", "corner : opposite corner : colorize"},
        {"hyper_shell", shell, {3}},
        {"plate_with_a_hole",
         "inner radius : outer radius : padding at the bottom : at the top : "
         "left : right : centre : manifold id : manifold id : length : slices "
         ": colorize",
         {10}},
        {"quarter_hyper_ball", "centre : radius"},
        {"quarter_hyper_shell", shell, {3}},
        {"simplex", "vertices separated by ';'"},
        {"subdivided_cylinder",
         "axial cells : radius : half length",
         {0},
         true},
        {"subdivided_hyper_cube", "cells : left : right : colorize", {0}},
        {"subdivided_hyper_rectangle",
         "cells per direction : corner : opposite corner : colorize",
         {0}},
        {"torus",
         "radius of the ring : radius of the tube : cells along the ring : "
         "angle",
         {2},
         true},
        {"truncated_cone", "radius : other radius : half length"}};
      return generators;
    }



    /** What deal.II says about an exception, without where and why. */
    std::string
    reason(const ExceptionBase &error)
    {
      std::ostringstream whole;
      error.print_info(whole);
      std::istringstream lines(whole.str());
      std::string        line;
      while (std::getline(lines, line))
        {
          line = Utilities::trim(line);
          if (!line.empty() && line != "(none)")
            return line;
        }
      return error.get_exc_name();
    }



    /** Numbers of cells are whole, not negative and not so many that the cells
     * fit nowhere; generators look at none of this. */
    template <int dim>
    void
    check_counts(const MeshSource  &source,
                 const Generator   &generator,
                 const std::string &allowed)
    {
      const auto arguments =
        Utilities::split_string_list(source.arguments, ':');
      double n_cells = 1;
      for (const unsigned int i : generator.counts)
        if (i < arguments.size())
          for (const std::string &count :
               Utilities::split_string_list(arguments[i], ','))
            {
              if (count.empty() || count[0] == '-' || count.size() > 9)
                reject("Mesh",
                       "Arguments",
                       source.arguments,
                       allowed + "; '" + count +
                         "' is a number of cells: whole, from 0 to 999999999");
              const double n = std::max(1., std::atof(count.c_str()));
              // The arms of a cross do not multiply.
              n_cells = generator.name == "hyper_cross" ? n_cells + n :
                        generator.name == "subdivided_hyper_cube" ?
                                                          std::pow(n, dim) :
                                                          n_cells * n;
            }
      require_memory_for_cells<dim>(n_cells, place("Mesh", "Arguments"));
    }



    template <int dim>
    void
    generate(const MeshSource &source, Triangulation<dim> &cells)
    {
      std::vector<std::string> names;
      const Generator         *generator = nullptr;
      for (const Generator &candidate : all_generators())
        if (dim == 3 || !candidate.only_3d)
          {
            names.push_back(candidate.name);
            if (candidate.name == source.generator)
              generator = &candidate;
          }
      if (generator == nullptr)
        throw InputError(place("Mesh", "Generator") + ": found '" +
                         source.generator + "', which is not known in " +
                         std::to_string(dim) + "D" +
                         suggest(source.generator, names));
      const std::string allowed =
        "arguments of " + generator->name + ": " + generator->arguments;
      check_counts<dim>(source, *generator, allowed);
      // A generator built with assertions would end the program.
      struct ThrowInsteadOfAbort
      {
        ThrowInsteadOfAbort()
        {
          deal_II_exceptions::disable_abort_on_exception();
        }
        ~ThrowInsteadOfAbort()
        {
          deal_II_exceptions::enable_abort_on_exception();
        }
      };
      try
        {
          const ThrowInsteadOfAbort guard;
          GridGenerator::generate_from_name_and_arguments(cells,
                                                          source.generator,
                                                          source.arguments);
        }
      catch (const Patterns::Tools::ExcNoMatch &)
        {
          reject("Mesh", "Arguments", source.arguments, allowed);
        }
      catch (const ExceptionBase &error)
        {
          reject("Mesh",
                 "Arguments",
                 source.arguments,
                 allowed + ". The generator says: " + reason(error));
        }
      if (cells.n_active_cells() == 0)
        reject("Mesh", "Arguments", source.arguments, allowed);
    }



    template <int dim>
    void
    read(const MeshSource &source, Triangulation<dim> &cells)
    {
      const std::string kind = dim == 2 ? "quadrilaterals" : "hexahedra";
      std::ifstream     in(source.file);
      if (!in)
        throw InputError(place("Mesh", "File") + ": found '" + source.file +
                         "', which cannot be read, allowed: the path of a .msh "
                         "file");
      const auto refuse = [&](const std::string &why) {
        throw InputError(place("Mesh", "File") + ": found '" + source.file +
                         "', which is not understood (" + why +
                         "), allowed: " + kind +
                         " in format 2 or 4 of gmsh as text, with physical ids "
                         "of lower dimension on the boundary only" +
                         (dim == 3 ? ", or a plane mesh with 'Extrusion "
                                     "layers'" :
                                     ""));
      };
      const std::string complaint = complaint_about_msh(in);
      if (!complaint.empty())
        refuse(complaint);
      in.clear();
      in.seekg(0);
      try
        {
          GridIn<dim>(cells).read_msh(in);
        }
      catch (const ExceptionBase &error)
        {
          refuse(reason(error));
        }
      for (const auto &cell : cells.active_cell_iterators())
        if (!cell->reference_cell().is_hyper_cube())
          {
            std::ostringstream message;
            message << place("Mesh", "File") << ": found '" << source.file
                    << "' with a cell of "
                    << cell->reference_cell().n_vertices() << " corners at ("
                    << cell->center() << "), allowed: " << kind
                    << " only; in gmsh recombine the surface and check that no "
                       "triangle is left ('Mesh.SubdivisionAlgorithm = 1')";
            throw InputError(message.str());
          }
    }



    [[noreturn]] void
    refuse_cells(const MeshSource &source, const std::string &what)
    {
      const bool is_file = source.type == "file";
      throw InputError(
        place("Mesh", is_file ? "File" : "Arguments") + ": found '" +
        (is_file ? source.file : source.arguments) + "' with " + what);
    }



    /** Join cells of generators that touch with vertices of their own. Those of
     * files are refused, but where a physical id says that a slit is meant. */
    template <int dim>
    void
    close_cracks(const MeshSource &source, Triangulation<dim> &cells)
    {
      const auto pairs = coincident_vertices(cells);
      if (source.type == "generator")
        {
          if (!pairs.empty() && source.generator != "hyper_cube_slit")
            join_cells(pairs, cells);
          return;
        }
      const std::string allowed =
        std::string(", allowed: cells with common vertices, or, for a slit or "
                    "bodies apart, physical ") +
        (dim == 2 ? "curves" : "surfaces") + " with the faces that touch";
      std::ostringstream what;
      if (const auto x = find_torn_face(pairs, cells))
        what << "cells that touch at (" << *x << ") and are not joined, "
             << pairs.size() << " vertices being there twice" << allowed;
      else if (const auto x = find_unmatched_vertex(cells))
        what << "a vertex at (" << *x << ") that lies on a face of another cell"
             << allowed;
      if (!what.str().empty())
        refuse_cells(source, what.str());
    }



    /** The cells of @p rough on one level and without manifolds. */
    template <int dim>
    void
    flatten(const Triangulation<dim> &rough, Triangulation<dim> &flat)
    {
      GridGenerator::flatten_triangulation(rough, flat);
      flat.reset_all_manifolds();
      flat.set_all_manifold_ids(numbers::flat_manifold_id);
    }



    template <int dim>
    void
    make_cells(const MeshSource &source, Triangulation<dim> &cells)
    {
      Triangulation<dim> rough;
      if (source.type == "generator")
        generate(source, rough);
      else
        read(source, rough);
      const auto inverted =
        find_inverted_cell<dim>(rough, rough.get_vertices());
      if (inverted)
        {
          std::ostringstream what;
          what << "a cell at (" << *inverted
               << ") that is flat or turned inside out at a corner, allowed: "
                  "convex cells";
          refuse_cells(source, what.str());
        }
      close_cracks(source, rough);
      require_memory_for_cells<dim>(rough.n_active_cells() *
                                      std::pow(2., dim * source.refinements),
                                    place("Mesh", "Refinements"));
      rough.refine_global(source.refinements);
      flatten(rough, cells);
    }



    template <int dim>
    std::set<types::boundary_id>
    ids_of_boundary(const Triangulation<dim> &triangulation)
    {
      std::set<types::boundary_id> ids;
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
          ids.insert(face->boundary_id());
      return ids;
    }



    /** What gmsh calls the boundary; bottom and top are of the extrusion. */
    template <int dim>
    std::vector<std::pair<std::string, types::boundary_id>>
    names_in_file(const MeshParameters<dim> &parameters)
    {
      std::vector<std::pair<std::string, types::boundary_id>> names;
      const bool is_extruded = parameters.extrusion_layers > 0;
      if (parameters.type != "file")
        return names;
      std::ifstream in(parameters.file);
      for (const auto &[name, number] :
           physical_names_of_msh(in, is_extruded ? 1 : dim - 1))
        if (!is_extruded || (name != "bottom" && name != "top"))
          names.emplace_back(name, number);
      return names;
    }
  } // namespace



  template <int dim>
  MeshSides
  make_mesh(const MeshParameters<dim> &parameters,
            Triangulation<dim>        &triangulation)
  {
    parameters.check();
    const auto name_sides = [&](const std::set<types::boundary_id> &ids) {
      return read_side_names(parameters.side_names,
                             ids,
                             names_in_file(parameters));
    };
    if constexpr (dim == 3)
      if (parameters.extrusion_layers > 0)
        {
          Triangulation<2> plane;
          make_cells(parameters, plane);
          const auto ids   = ids_of_boundary(plane);
          MeshSides  sides = name_sides(ids);
          for (const auto &side : sides.names)
            if (side.first == "bottom" || side.first == "top")
              reject("Mesh",
                     "Side names",
                     side.first,
                     "other names; bottom and top are those of the extrusion");
          Triangulation<3> extruded;
          require_memory_for_cells<3>(1. * plane.n_active_cells() *
                                        parameters.extrusion_layers,
                                      place("Mesh", "Extrusion layers"));
          GridGenerator::extrude_triangulation(plane,
                                               parameters.extrusion_layers + 1,
                                               parameters.extrusion_height,
                                               extruded);
          flatten(extruded, triangulation);
          // deal.II numbers the new sides after the largest id of the plane.
          sides.names.emplace_back("bottom", *ids.rbegin() + 1);
          sides.names.emplace_back("top", *ids.rbegin() + 2);
          return sides;
        }
    make_cells<dim>(parameters, triangulation);
    return name_sides(ids_of_boundary(triangulation));
  }



  template <int dim>
  CellGroups
  groups_of_cells(const MeshParameters<dim> &parameters,
                  const Triangulation<dim>  &cells)
  {
    CellGroups groups;
    if (parameters.type != "file")
      return groups;
    std::set<types::material_id> ids;
    for (const auto &cell : cells.active_cell_iterators())
      ids.insert(cell->material_id());
    std::ifstream in(parameters.file);
    const auto    named =
      physical_names_of_msh(in, parameters.extrusion_layers > 0 ? 2 : dim);
    for (const types::material_id id : ids)
      {
        std::string name = std::to_string(id);
        for (const auto &[given, number] : named)
          if (number == id)
            name = given;
        groups.emplace_back(name, id);
      }
    return groups;
  }



  template <int dim>
  void
  require_memory_for_cells(const double n, const std::string &where)
  {
    // The triangulation and numbers of nodes alone, every rank having all.
    const double bytes_per_cell =
      (dim == 2 ? 500. : 1500.) *
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::ostringstream what;
    what << where << ": found " << n << " cells";
    require_memory(n * bytes_per_cell, what.str());
  }



  template <int dim>
  std::optional<Point<dim>>
  find_inverted_cell(const Triangulation<dim>      &triangulation,
                     const std::vector<Point<dim>> &vertices)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        CellVertices<dim> corners;
        Point<dim>        centre;
        double            size = 0;
        for (unsigned int v = 0; v < corners.size(); ++v)
          {
            corners[v] = vertices[cell->vertex_index(v)];
            centre += (1. / corners.size()) * corners[v];
            size = std::max(size, corners[v].distance(corners[0]));
          }
        const CellMap<dim> map(corners);
        for (unsigned int v = 0; v < corners.size(); ++v)
          if (!(determinant(map.jacobian(GeometryInfo<dim>::unit_cell_vertex(
                  v))) > 1e-12 * Utilities::fixed_power<dim>(size)))
            return centre;
      }
    return {};
  }



#define INSTANTIATE(dim)                                                    \
  template decltype(make_mesh<dim>)       make_mesh<dim>;                   \
  template decltype(groups_of_cells<dim>) groups_of_cells<dim>;             \
  template decltype(require_memory_for_cells<dim>)                          \
                                             require_memory_for_cells<dim>; \
  template decltype(find_inverted_cell<dim>) find_inverted_cell<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
