// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/make_mesh.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/nearest.h>
#include <moraine/mesh/cell_map.h>
#include <moraine/mesh/msh_file.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>

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
      bool        only_3d = false;
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
         "width of the shell : number of shells : skewness : colorize"},
        {"cheese", "numbers of holes"},
        {"concentric_hyper_shells",
         "centre : inner radius : outer radius : number of shells : skewness "
         "(0: equal) : cells per shell (0: a few) : colorize"},
        {"cylinder", "radius : half length"},
        {"cylinder_shell",
         "length : inner radius : outer radius : radial cells : axial cells",
         true},
        {"eccentric_hyper_shell",
         "inner centre : outer centre : inner radius : outer radius : number "
         "of cells"},
        {"enclosed_hyper_cube", "left : right : thickness : colorize"},
        {"general_cell", "vertices separated by ';' : colorize"},
        {"half_hyper_ball", "centre : radius"},
        {"half_hyper_shell", shell},
        {"hyper_L", "left : right : colorize"},
        {"hyper_ball", "centre : radius : spherical manifold"},
        {"hyper_ball_balanced", "centre : radius"},
        {"hyper_cross", "sizes : colorize"},
        {"hyper_cube", "left : right : colorize"},
        {"hyper_cube_slit", "left : right : colorize"},
        {"hyper_cube_with_cylindrical_hole",
         "inner radius : half of the edge : length : layers : colorize"},
        {"hyper_rectangle", "corner : opposite corner : colorize"},
        {"hyper_shell", shell},
        {"plate_with_a_hole",
         "inner radius : outer radius : padding at the bottom : at the top : "
         "left : right : centre : manifold id : manifold id : length : slices "
         ": colorize"},
        {"quarter_hyper_ball", "centre : radius"},
        {"quarter_hyper_shell", shell},
        {"simplex", "vertices separated by ';'"},
        {"subdivided_cylinder", "axial cells : radius : half length", true},
        {"subdivided_hyper_cube", "cells : left : right : colorize"},
        {"subdivided_hyper_rectangle",
         "cells per direction : corner : opposite corner : colorize"},
        {"torus",
         "radius of the ring : radius of the tube : cells along the ring : "
         "angle",
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
          const bool         is_file = source.type == "file";
          std::ostringstream message;
          message << place("Mesh", is_file ? "File" : "Arguments")
                  << ": found '" << (is_file ? source.file : source.arguments)
                  << "' with a cell at (" << *inverted
                  << ") that is flat or turned inside out at a corner, allowed:"
                     " convex cells";
          throw InputError(message.str());
        }
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
                             parameters.type == "file");
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
  template MeshSides                 make_mesh(const MeshParameters<dim> &, \
                                               Triangulation<dim> &);       \
  template std::optional<Point<dim>> find_inverted_cell(                    \
    const Triangulation<dim> &, const std::vector<Point<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
