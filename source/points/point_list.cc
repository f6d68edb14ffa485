// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/point_list.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/input_text.h>
#include <moraine/core/memory.h>
#include <moraine/geometry/shape_library.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <functional>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    [[noreturn]] void
    refuse(const std::string &file_name,
           const unsigned int line,
           const std::string &what)
    {
      throw InputError(file_name + ":" + std::to_string(line) + ": " + what);
    }

    std::vector<std::string>
    cells_of(const std::string &line)
    {
      std::vector<std::string> cells;
      std::istringstream       in(line);
      for (std::string cell; std::getline(in, cell, ',');)
        cells.push_back(Utilities::trim(cell));
      // a comma at the end is followed by an empty value
      if (line.back() == ',')
        cells.emplace_back();
      return cells;
    }

    /** The text, or its beginning. */
    std::string
    shortened(const std::string &text)
    {
      constexpr std::size_t longest = 80;
      return text.size() <= longest ? text : text.substr(0, longest) + "...";
    }

    double
    to_number(const std::string &cell,
              const std::string &column,
              const std::string &file_name,
              const unsigned int line)
    {
      double number = std::numeric_limits<double>::quiet_NaN();
      try
        {
          number = Utilities::string_to_double(cell);
        }
      catch (const ExceptionBase &)
        {}
      if (!std::isfinite(number))
        refuse(file_name,
               line,
               "column '" + shortened(column) + "': found '" + shortened(cell) +
                 "'. Allowed: a finite number");
      return number;
    }

    template <int dim>
    std::vector<std::string>
    read_header(const std::string &text,
                const std::string &file_name,
                const unsigned int line)
    {
      const std::string allowed = dim == 2 ? "x,y,volume" : "x,y,z,volume";
      const auto        names   = cells_of(text);
      const auto        fixed   = Utilities::split_string_list(allowed, ',');
      if (names.size() < fixed.size() ||
          !std::equal(fixed.begin(), fixed.end(), names.begin()))
        refuse(file_name,
               line,
               "found the header '" + shortened(text) + "'. Allowed in " +
                 std::to_string(dim) + "D: " + allowed +
                 " and, if wanted, names of more columns");
      std::set<std::string> earlier;
      for (const std::string &name : names)
        if (name.find_first_of("\"<>&/") != std::string::npos)
          refuse(file_name,
                 line,
                 "found the column name '" + shortened(name) +
                   "', allowed: a name without '\"', '<', '>', '&' and '/'");
        else if (name.empty() || !earlier.insert(name).second)
          refuse(file_name,
                 line,
                 "the column name '" + shortened(name) + "' is " +
                   (name.empty() ? "empty" : "given twice"));
      return names;
    }
  } // namespace



  template <int dim>
  PointList<dim>
  read_point_file(const std::string &file_name)
  {
    std::ifstream in(file_name);
    if (!in)
      throw InputError("The point file '" + file_name + "' cannot be read.");
    PointList<dim>            points;
    std::vector<unsigned int> lines;
    std::vector<std::string>  names;
    std::string               text;
    for (unsigned int line = 1; std::getline(in, text); ++line)
      {
        text = Utilities::trim(line == 1 ? without_mark(text) : text);
        if (text.empty())
          continue;
        if (names.empty())
          {
            names = read_header<dim>(text, file_name, line);
            continue;
          }
        const auto cells = cells_of(text);
        if (cells.size() != names.size())
          refuse(file_name,
                 line,
                 "found " + std::to_string(cells.size()) +
                   " values. Allowed: " + std::to_string(names.size()) +
                   ", one for each column of the header");
        std::vector<double> row;
        for (unsigned int i = 0; i < cells.size(); ++i)
          row.push_back(to_number(cells[i], names[i], file_name, line));
        if (!(row[dim] > 0.))
          refuse(file_name,
                 line,
                 "column 'volume': found '" + cells[dim] +
                   "'. Allowed: a number > 0");
        Point<dim> position;
        std::copy_n(row.begin(), dim, position.begin_raw());
        lines.push_back(line);
        points.positions.push_back(position);
        points.volumes.push_back(row[dim]);
        points.column_values.emplace_back(row.begin() + dim + 1, row.end());
      }
    if (points.positions.empty())
      throw InputError("The point file '" + file_name + "' has no points.");
    points.columns.assign(names.begin() + dim + 1, names.end());
    points.origin = [file_name, lines](const unsigned int i) {
      return file_name + ':' + std::to_string(lines[i]);
    };
    return points;
  }



  template <int dim>
  PointList<dim>
  make_point_grid(const ShapeParameters<dim>      &box,
                  const std::vector<unsigned int> &n,
                  const std::string               &section)
  {
    const Placement<dim> placement = make_placement(box, section);
    const auto           lower     = box.point("Lower corner", section);
    Tensor<1, dim>       length    = box.point("Upper corner", section) - lower;
    const double         n_in_grid =
      std::accumulate(n.begin(), n.end(), 1., std::multiplies<double>());
    std::ostringstream what;
    what << place(section, "Point grid") << ": found " << n_in_grid
         << " points";
    require_memory(300. * n_in_grid, what.str());
    double       volume   = 1;
    unsigned int n_points = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        length[d] /= n[d];
        volume *= length[d];
        n_points *= n[d];
      }
    PointList<dim> points;
    for (unsigned int i = 0; i < n_points; ++i)
      {
        Point<dim>   x    = lower;
        unsigned int rest = i;
        for (unsigned int d = 0; d < dim; rest /= n[d], ++d)
          x[d] += (rest % n[d] + 0.5) * length[d];
        points.positions.push_back(placement.map(x));
      }
    points.volumes.assign(n_points, volume);
    for (unsigned int d = 0; d < dim; ++d)
      {
        Point<dim> end = lower;
        end[d] += length[d];
        const Tensor<1, dim> edge = placement.map(end) - placement.map(lower);
        for (unsigned int i = 0; i < dim; ++i)
          points.half_edges[i][d] = 0.5 * edge[i];
      }
    points.origin = [section](const unsigned int) {
      return "section '" + section + "', key 'Point grid'";
    };
    return points;
  }



  template decltype(read_point_file<2>) read_point_file<2>;
  template decltype(read_point_file<3>) read_point_file<3>;
  template decltype(make_point_grid<2>) make_point_grid<2>;
  template decltype(make_point_grid<3>) make_point_grid<3>;
} // namespace moraine
