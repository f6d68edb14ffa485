// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/output/mesh_vtu.h>
#include <moraine/output/point_vtu.h>
#include <moraine/output/pvd_history.h>
#include <moraine/output/vtu_file.h>

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>

#include "../basis/domain_scene.h"
#include "scene.h"

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** A field of a VTU file, the pieces of all ranks one after the other. */
    struct Array
    {
      unsigned int       n_components = 0;
      std::string        unit;
      std::string        unit_for_vtk;
      std::string        second_component;
      std::vector<float> values;
    };

    std::string
    attribute(const std::string &tag, const std::string &name)
    {
      const auto start = tag.find(" " + name + "=\"");
      if (start == std::string::npos)
        return "";
      const auto first = start + name.size() + 3;
      return tag.substr(first, tag.find('"', first) - first);
    }

    /** Compressed binary data as VTK defines it, in one block. */
    template <typename Number>
    std::vector<float>
    decode(const std::string &text)
    {
      std::uint32_t     head[4];
      const std::size_t head_length = 24;
      const auto        head_bytes =
        Utilities::decode_base64(text.substr(0, head_length));
      std::memcpy(head, head_bytes.data(), sizeof(head));
      EXPECT_EQ(head[0], 1u);
      const auto packed = Utilities::decode_base64(text.substr(head_length));
      std::vector<Number> values(head[1] / sizeof(Number));
      uLongf              size = head[1];
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(values.data()),
                           &size,
                           packed.data(),
                           head[3]),
                Z_OK);
      EXPECT_EQ(size, head[1]);
      return {values.begin(), values.end()};
    }

    std::map<std::string, Array>
    read_vtu(const std::string &path)
    {
      std::map<std::string, Array> arrays;
      const std::string            text = content(path);
      EXPECT_EQ(text.substr(0, 5), "<?xml");
      EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
      const std::string open = "<DataArray";
      std::size_t       at   = text.find(open);
      while (at != std::string::npos)
        {
          const std::size_t end = text.find('>', at);
          const std::string tag = text.substr(at, end - at);
          std::string       data =
            text.substr(end + 1, text.find("</DataArray", end) - end - 1);
          at                     = text.find(open, end);
          const std::string type = attribute(tag, "type");
          if (type.substr(0, 5) != "Float" ||
              attribute(tag, "format") != "binary")
            continue;
          const std::string name  = attribute(tag, "Name");
          const std::string n     = attribute(tag, "NumberOfComponents");
          Array            &array = arrays[name.empty() ? "position" : name];
          array.n_components      = n.empty() ? 1 : std::stoi(n);
          array.unit              = attribute(tag, "units");
          array.second_component  = attribute(tag, "ComponentName1");
          const std::size_t key   = data.find("<InformationKey");
          if (key != std::string::npos)
            {
              const std::size_t value   = data.find('>', key);
              const std::string element = data.substr(key, value - key);
              EXPECT_EQ(attribute(element, "name"), "UNITS_LABEL");
              EXPECT_EQ(attribute(element, "location"), "vtkDataArray");
              array.unit_for_vtk =
                data.substr(value + 1, data.find('<', value) - value - 1);
              data.erase(key);
            }
          data.erase(std::remove_if(data.begin(),
                                    data.end(),
                                    [](unsigned char c) {
                                      return std::isspace(c) != 0;
                                    }),
                     data.end());
          if (data.empty())
            continue;
          const auto values =
            type == "Float64" ? decode<double>(data) : decode<float>(data);
          array.values.insert(array.values.end(), values.begin(), values.end());
        }
      return arrays;
    }

    std::vector<float>
    of_point(const Array &array, const unsigned int i)
    {
      const auto first = array.values.begin() + i * array.n_components;
      return {first, first + array.n_components};
    }

    template <int dim>
    void
    check_points(const Folder &folder)
    {
      const BackgroundMesh<dim> mesh(mesh_parameters<dim>(), MPI_COMM_WORLD);
      PointFields               layout;
      const auto                plastic =
        layout.request(FieldName<dim, double>{"plastic_strain", "-"});
      PointSet<dim> points(mesh, layout);
      fill(points);
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          double *values = points.values(p);
          plastic.store(0.5, values);
          values[points.displacement_offset() + 1] = points.id(p);
          for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
            values[points.stress_offset() + c] = c + 1;
        }
      const std::string path = folder.file("points.vtu");
      write_point_vtu(points, {path, 2.5, 3});

      auto arrays = read_vtu(path);
      ASSERT_EQ(arrays["id"].values.size(), points.n_global());
      ASSERT_EQ(arrays["displacement"].n_components, 3u);
      ASSERT_EQ(arrays["stress"].n_components, 9u);
      EXPECT_EQ(arrays["displacement"].unit, "length");
      EXPECT_EQ(arrays["stress"].unit, "stress");
      EXPECT_EQ(arrays["stress"].unit_for_vtk, "stress");
      EXPECT_EQ(arrays["stress"].second_component, "xy");
      EXPECT_EQ(arrays["displacement"].unit_for_vtk, "length");
      EXPECT_EQ(arrays["displacement"].second_component, "");
      EXPECT_EQ(arrays["id"].unit_for_vtk, "");
      EXPECT_EQ(arrays["volume"].unit, dim == 2 ? "length^2" : "length^3");
      EXPECT_EQ(arrays["body"].values, std::vector<float>(16, 0.f));
      EXPECT_EQ(arrays["plastic_strain"].values, std::vector<float>(16, 0.5f));

      const std::vector<float> stress =
        dim == 2 ? std::vector<float>{1, 4, 0, 4, 2, 0, 0, 0, 3} :
                   std::vector<float>{1, 4, 5, 4, 2, 6, 5, 6, 3};
      std::vector<float> ids = arrays["id"].values;
      for (unsigned int i = 0; i < ids.size(); ++i)
        {
          EXPECT_EQ(of_point(arrays["stress"], i), stress);
          EXPECT_EQ(of_point(arrays["displacement"], i),
                    (std::vector<float>{0, ids[i], 0}));
          // von Mises: 3/2 s:s with s = (-1, 0, 1), 4, (5, 6)
          EXPECT_FLOAT_EQ(arrays["von_mises_stress"].values[i],
                          std::sqrt(dim == 2 ? 51. : 234.));
          EXPECT_FLOAT_EQ(arrays["mean_stress"].values[i], 2.);
          // fill(): cell index and which of the two points follow from the id
          const unsigned int number = 100 - static_cast<int>(ids[i]);
          EXPECT_EQ(std::fmod(arrays["position"].values[3 * i], 1.f),
                    0.25f + 0.5f * (number % 2));
        }
      if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
        {
          EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
        }
      std::sort(ids.begin(), ids.end());
      for (unsigned int i = 0; i < ids.size(); ++i)
        EXPECT_EQ(ids[i], 85 + i);
      EXPECT_FALSE(std::filesystem::exists(path + ".part"));
    }
  } // namespace



  TEST(PointVtu, named_vectors_and_tensors)
  {
    const Folder folder;
    check_points<2>(folder);
    check_points<3>(folder);
  }



  TEST(PointVtu, a_rank_without_points)
  {
    const Folder            folder;
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    const auto              cell = mesh.triangulation().begin_active();
    if (cell->is_locally_owned())
      points.insert(cell, cell->center(), Point<2>(0.5, 0.5), 7, 0, 1.);
    points.finish_insertion();
    const std::string path = folder.file("one.vtu");
    write_point_vtu(points, {path, 0., 0});
    EXPECT_EQ(read_vtu(path)["id"].values, std::vector<float>{7.f});
  }



  TEST(PointVtu, failed_write_is_told_to_all_ranks)
  {
    const Folder            folder;
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, {});
    fill(points);
    const std::string path = folder.file("no-such-folder/points.vtu");
    try
      {
        write_point_vtu(points, {path, 0., 0});
        FAIL() << "nothing thrown";
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos)
          << error.what();
      }
  }



  template <int dim>
  void
  check_domains(const Folder &folder)
  {
    DomainSceneOptions options;
    options.method = Method::cpdi1;
    options.lower  = 1;
    options.upper  = 3;
    DomainScene<dim> scene(options);
    scene.accept(scene.nodal([](const Point<dim> &x) {
      Tensor<1, dim> u;
      u[0] = 0.5 * (x[1] - 2); // simple shear
      return u;
    }));
    const std::string path = folder.file("domains.vtu");
    write_domain_vtu(*scene.basis, scene.points, {path, 0., 0});

    auto                   arrays    = read_vtu(path);
    constexpr unsigned int n_corners = 1 << dim;
    const unsigned int     n         = scene.points.n_global();
    const auto             ids       = arrays["id"].values;
    const auto             edges     = arrays["half_edge_2"].values;
    const auto             places    = arrays["position"].values;
    ASSERT_EQ(ids.size(), n_corners * n);
    ASSERT_EQ(arrays["deformation_gradient"].n_components, 9u);
    std::vector<float> F{1, 0.5, 0, 0, 1, 0, 0, 0, 1};
    for (unsigned int i = 0; i < n_corners * n; ++i)
      {
        EXPECT_EQ(ids[i], ids[i - i % n_corners]);
        EXPECT_NEAR(edges[3 * i], 0.125, 1e-6);
        EXPECT_NEAR(edges[3 * i + 1], 0.25, 1e-6);
        for (unsigned int c = 0; c < 9; ++c)
          EXPECT_NEAR(of_point(arrays["deformation_gradient"], i)[c],
                      F[c],
                      1e-6);
      }
    // VTK numbers the corners of a domain as deal.II does in a patch.
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(places[3 * (n_corners * i + 2) + d] -
                      places[3 * n_corners * i + d],
                    d == 0 ? 0.25 : 0.5,
                    1e-6);
  }



  TEST(DomainVtu, corners_and_fields)
  {
    const Folder folder;
    check_domains<2>(folder);
    check_domains<3>(folder);
  }



  TEST(MeshVtu, deformed_active_cells)
  {
    const Folder            folder;
    const BackgroundMesh<2> mesh(mesh_parameters<2>(), MPI_COMM_WORLD);
    for (const unsigned int degree : {1u, 2u})
      {
        GridSpace<2>               space(mesh, degree);
        std::vector<unsigned char> active(8, 0);
        active[0] = active[7] = 1;
        space.set_active_cells(active);
        std::vector<Tensor<1, 2>> u(space.n_nodes());
        for (unsigned int n = 0; n < u.size(); ++n)
          u[n][0] = 10 + space.node_position(n)[1];
        space.move_nodes(u);
        const std::string path = folder.file("mesh.vtu");
        // Points in the first of the two cells only, with a stress that grows.
        PointSet<2> points(mesh, {});
        const auto  cell = mesh.triangulation().begin_active();
        if (cell->is_locally_owned())
          for (const double xi : {0.25, 0.75})
            points.insert(cell,
                          cell->vertex(0) + Point<2>(xi, 0.5),
                          {xi, 0.5},
                          2 * xi,
                          0,
                          1.);
        points.finish_insertion();
        for (unsigned int p = 0; p < points.n_local(); ++p)
          for (unsigned int c = 0; c < 3; ++c)
            points.values(p)[points.stress_offset() + c] =
              points.reference_position(p)[0];
        write_mesh_vtu<2>(space,
                          {{"step_displacement", "length", u}},
                          SmoothedStress<2>(points),
                          {path, 1., 1});

        auto arrays = read_vtu(path);
        EXPECT_EQ(arrays["smoothed_stress"].n_components, 9u);
        EXPECT_EQ(arrays["smoothed_stress"].unit, "stress");
        auto means = arrays["smoothed_mean_stress"].values;
        ASSERT_EQ(means.size(), 2 * (degree + 1) * (degree + 1));
        std::sort(means.begin(), means.end());
        EXPECT_EQ(means.front(), 0.f);
        EXPECT_FLOAT_EQ(means.back(), 0.25 * 0.25 + 0.75 * 0.75);
        if (degree == 2)
          {
            EXPECT_EQ(std::count(means.begin(), means.end(), 0.5f), 3);
          }
        for (const float value : arrays["smoothed_von_mises_stress"].values)
          EXPECT_NEAR(value, 0., 1e-6);
        const auto values = arrays["step_displacement"].values;
        const auto places = arrays["position"].values;
        EXPECT_EQ(arrays["step_displacement"].n_components, 3u);
        ASSERT_EQ(values.size(), 3 * 2 * (degree + 1) * (degree + 1));
        ASSERT_EQ(places.size(), values.size());
        double sum_x = 0;
        for (unsigned int i = 0; i < values.size(); i += 3)
          {
            EXPECT_FLOAT_EQ(values[i], 10 + places[i + 1]);
            sum_x += places[i] - values[i];
          }
        // Nodes of two equal squares: their mean place is that of the centres.
        Point<2> centre;
        for (const auto &cell : mesh.triangulation().active_cell_iterators())
          if (active[cell->active_cell_index()] != 0)
            centre += 0.5 * cell->center();
        EXPECT_NEAR(sum_x / (values.size() / 3.), centre[0], 1e-5);
      }
  }



  TEST(VtuFile, holds_a_piece_of_a_large_file_at_a_time)
  {
    const Folder      folder;
    const std::string path = folder.file("large.vtu");
    const auto        rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const auto        n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    // Without patches on the last rank, where there are three of them.
    const unsigned int n = rank == 2 ? 0 : 40000;
    VtuFile<0, 2>      file({path, 0., 0});
    file.add_scalar("number", "-");
    file.write(MPI_COMM_WORLD, n, [&](const unsigned int i) {
      VtuFile<0, 2>::Patch patch;
      patch.vertices[0] = Point<2>(i, rank);
      patch.data.reinit(1, 1);
      patch.data(0, 0) = 1e5 * rank + i;
      return patch;
    });

    const unsigned int n_writing = std::min(n_ranks, 2u);
    const std::string  text      = content(path);
    const std::string  tag       = "<Piece";
    unsigned int       n_pieces  = 0;
    for (auto at = text.find(tag); at != std::string::npos;
         at      = text.find(tag, at + 1))
      ++n_pieces;
    EXPECT_EQ(n_pieces, 3 * n_writing);
    auto        arrays  = read_vtu(path);
    const auto &numbers = arrays["number"].values;
    ASSERT_EQ(numbers.size(), 40000 * n_writing);
    ASSERT_EQ(arrays["position"].values.size(), 3 * numbers.size());
    for (unsigned int i = 0; i < numbers.size(); ++i)
      {
        ASSERT_EQ(numbers[i], 1e5 * (i / 40000) + i % 40000);
        ASSERT_EQ(arrays["position"].values[3 * i], i % 40000);
      }
  }



  TEST(PvdHistory, is_complete_after_every_step)
  {
    const Folder      folder;
    const std::string path = folder.file("points.pvd");
    PvdHistory        history(path, MPI_COMM_WORLD);
    history.add(0., "points/00000.vtu");
    EXPECT_NE(content(path).find("</VTKFile>"), std::string::npos);
    MPI_Barrier(MPI_COMM_WORLD);
    history.add(0.5, "points/00001.vtu");
    const std::string text = content(path);
    EXPECT_NE(text.find("timestep=\"0\" group=\"\" part=\"0\" "
                        "file=\"points/00000.vtu\""),
              std::string::npos)
      << text;
    EXPECT_NE(text.find("timestep=\"0.5\" group=\"\" part=\"0\" "
                        "file=\"points/00001.vtu\""),
              std::string::npos)
      << text;
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
  }
} // namespace moraine
