// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/vtu_file.h>

#include <moraine/core/atomic_file.h>
#include <moraine/output/component_names.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <sstream>

namespace moraine
{
  using namespace dealii;
  using DataComponentInterpretation::component_is_part_of_tensor;
  using DataComponentInterpretation::component_is_part_of_vector;

  namespace
  {
    /** About 60 MB of boxes in 3D. */
    constexpr unsigned int patches_of_a_piece = 16384;

    constexpr int tag = 0;



    void
    send_to_root(const std::string &text, const MPI_Comm &communicator)
    {
      MPI_Send(text.data(), text.size(), MPI_CHAR, 0, tag, communicator);
    }



    /** Write the pieces of a rank into @p out until it sends an empty one. */
    void
    receive_pieces(const unsigned int rank,
                   std::ostream      &out,
                   const MPI_Comm    &communicator)
    {
      std::string received;
      do
        {
          MPI_Status status;
          int        size = 0;
          MPI_Probe(rank, tag, communicator, &status);
          MPI_Get_count(&status, MPI_CHAR, &size);
          received.resize(size);
          MPI_Recv(received.data(),
                   size,
                   MPI_CHAR,
                   rank,
                   tag,
                   communicator,
                   MPI_STATUS_IGNORE);
          out << received;
        }
      while (!received.empty());
    }



    /**
     * Give an array that deal.II has written what VTK's readers look for: names
     * of the components of a tensor, and the unit as VTK's own key (deal.II's
     * attribute "units" is not read by VTK). A piece has every array once.
     */
    void
    annotate(std::string       &text,
             const std::string &name,
             const std::string &unit)
    {
      const std::string head  = "Name=\"" + name + "\" ";
      const auto        begin = text.find(head);
      if (begin == std::string::npos)
        return;
      const std::string tensor = "NumberOfComponents=\"9\" ";
      const auto        after  = begin + head.size();
      if (text.compare(after, tensor.size(), tensor) == 0)
        {
          std::string components;
          for (unsigned int c = 0; c < 9; ++c)
            components += "ComponentName" + std::to_string(c) + "=\"" +
                          direction_name(c / 3) + direction_name(c % 3) + "\" ";
          text.insert(after + tensor.size(), components);
        }
      if (!unit.empty())
        // VTK's readers take what comes first for the values.
        text.insert(text.find("</DataArray>", after),
                    "<InformationKey name=\"UNITS_LABEL\" "
                    "location=\"vtkDataArray\">" +
                      unit + "</InformationKey>\n");
    }



    /** What VTK reads as an array in one compressed block. */
    std::string
    encode(const std::vector<double> &values)
    {
      const uLong size   = values.size() * sizeof(double);
      uLongf      packed = compressBound(size);

      std::vector<unsigned char> block(packed);
      AssertThrow(compress2(block.data(),
                            &packed,
                            reinterpret_cast<const Bytef *>(values.data()),
                            size,
                            Z_BEST_SPEED) == Z_OK,
                  ExcInternalError());
      block.resize(packed);
      const std::uint32_t sizes[4] = {1,
                                      static_cast<std::uint32_t>(size),
                                      static_cast<std::uint32_t>(size),
                                      static_cast<std::uint32_t>(packed)};
      const auto *begin = reinterpret_cast<const unsigned char *>(sizes);
      return Utilities::encode_base64({begin, begin + sizeof(sizes)}) +
             Utilities::encode_base64(block);
    }



    /** Of what a patch draws; if it has places of its own, they are from its
     * first vertex. */
    template <typename Patch>
    void
    append_positions(const Patch &patch, std::vector<double> &positions)
    {
      constexpr unsigned int dim    = Patch::space_dim;
      const auto             append = [&positions](const Point<dim> &x) {
        for (unsigned int d = 0; d < 3; ++d)
          positions.push_back(d < dim ? x[d] : 0.);
      };
      if (!patch.points_are_available)
        for (const auto &x : patch.vertices)
          append(x);
      else
        for (unsigned int a = 0; a < patch.data.n_cols(); ++a)
          {
            Point<dim> x = patch.vertices[0];
            for (unsigned int d = 0; d < dim; ++d)
              x[d] += patch.data(patch.data.n_rows() - dim + d, a);
            append(x);
          }
    }



    /** Give the positions of a piece all their digits: what deal.II writes
     * tells places of a cell far from the origin no more apart. */
    template <typename Patch>
    void
    refine_positions(std::string &text, const std::vector<Patch> &patches)
    {
      std::vector<double> positions;
      for (const Patch &patch : patches)
        append_positions(patch, positions);
      const std::string open = "<Points>\n", close = "  </Points>";
      const auto        begin = text.find(open) + open.size();
      text.replace(begin,
                   text.find(close, begin) - begin,
                   "    <DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                   "format=\"binary\">\n" +
                     encode(positions) + "\n    </DataArray>\n");
    }
  } // namespace



  template <int patch_dim, int dim>
  void
  VtuFile<patch_dim, dim>::add_range(
    const std::string &name,
    const std::string &unit,
    const unsigned int n_components,
    const DataComponentInterpretation::DataComponentInterpretation
      interpretation)
  {
    ranges.emplace_back(names.size(),
                        names.size() + n_components - 1,
                        name,
                        interpretation);
    names.insert(names.end(), n_components, name);
    if (unit != "-")
      units[name] = target.units.of(unit);
  }



  template <int patch_dim, int dim>
  void
  VtuFile<patch_dim, dim>::add_scalar(const std::string &name,
                                      const std::string &unit)
  {
    names.push_back(name);
    if (unit != "-")
      units[name] = target.units.of(unit);
  }



  template <int patch_dim, int dim>
  void
  VtuFile<patch_dim, dim>::add_vector(const std::string &name,
                                      const std::string &unit)
  {
    add_range(name, unit, dim, component_is_part_of_vector);
  }



  template <int patch_dim, int dim>
  void
  VtuFile<patch_dim, dim>::add_tensor(const std::string &name,
                                      const std::string &unit)
  {
    add_range(name, unit, 9, component_is_part_of_tensor);
  }



  template <int patch_dim, int dim>
  std::string
  VtuFile<patch_dim, dim>::piece(const DataOutBase::VtkFlags &flags) const
  {
    std::ostringstream out;
    DataOutBase::write_vtu_main(
      patches, names, get_nonscalar_data_ranges(), flags, out);
    std::string text = out.str();
    refine_positions(text, patches);
    for (const std::string &name :
         std::set<std::string>(names.begin(), names.end()))
      annotate(text, name, units.count(name) > 0 ? units.at(name) : "");
    return text;
  }



  template <int patch_dim, int dim>
  void
  VtuFile<patch_dim, dim>::write(
    const MPI_Comm                                 &communicator,
    const unsigned int                              n_patches,
    const std::function<Patch(const unsigned int)> &make_patch)
  {
    // A date would make two equal runs differ.
    const DataOutBase::VtkFlags flags(target.time,
                                      target.step,
                                      false,
                                      DataOutBase::VtkFlags::best_speed,
                                      false,
                                      units);
    std::unique_ptr<AtomicFile> file;
    on_root(communicator, [&]() {
      file = std::make_unique<AtomicFile>(target.path);
      DataOutBase::write_vtu_header(file->stream(), flags);
    });
    // A rank without patches has no piece: deal.II would declare tensors of 3
    // components there.
    for (unsigned int begin = 0; begin < n_patches; begin += patches.size())
      {
        patches.resize(std::min(patches_of_a_piece, n_patches - begin));
        for (unsigned int i = 0; i < patches.size(); ++i)
          {
            patches[i]             = make_patch(begin + i);
            patches[i].patch_index = i;
          }
        if (file)
          file->stream() << piece(flags);
        else
          send_to_root(piece(flags), communicator);
      }
    if (!file)
      send_to_root("", communicator);
    else
      for (unsigned int rank = 1;
           rank < Utilities::MPI::n_mpi_processes(communicator);
           ++rank)
        receive_pieces(rank, file->stream(), communicator);
    on_root(communicator, [&]() {
      // deal.II takes a stream that failed for a mistake of ours.
      if (file->stream())
        DataOutBase::write_vtu_footer(file->stream());
      file->commit();
    });
  }



  template <int patch_dim, int dim>
  const std::vector<typename VtuFile<patch_dim, dim>::Patch> &
  VtuFile<patch_dim, dim>::get_patches() const
  {
    return patches;
  }



  template <int patch_dim, int dim>
  std::vector<std::string>
  VtuFile<patch_dim, dim>::get_dataset_names() const
  {
    return names;
  }



  template <int patch_dim, int dim>
  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               DataComponentInterpretation::DataComponentInterpretation>>
  VtuFile<patch_dim, dim>::get_nonscalar_data_ranges() const
  {
    return ranges;
  }



  template class VtuFile<0, 2>;
  template class VtuFile<0, 3>;
  template class VtuFile<2, 2>;
  template class VtuFile<3, 3>;
} // namespace moraine
