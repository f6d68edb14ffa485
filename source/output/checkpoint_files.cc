// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/checkpoint_files.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/version.h>
#include <moraine/output/component_names.h>
#include <moraine/output/on_root.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the data sets of a checkpoint and what they mean. */
    constexpr unsigned int format_number = 12;

    constexpr std::array<const char *, 2> slots{{"a", "b"}};



    /** "step 5 (t = 0.25)". */
    std::string
    in_words(const CheckpointLabel &label)
    {
      std::ostringstream text;
      text << "step " << label.step << " (t = " << std::setprecision(8)
           << label.t << ")";
      return text.str();
    }



    CheckpointLabel
    label_of(const std::string &path)
    {
      return CheckpointLabel::read(read_group(path, "checkpoint"), path);
    }



    bool
    is_asked_for(const CheckpointLabel &label, const std::string &from)
    {
      if (from.find_first_not_of("0123456789") == std::string::npos)
        return std::to_string(label.step) == from;
      std::istringstream text(from);
      double             t;
      return text >> t && text.eof() &&
             std::abs(label.t - t) <= 1e-7 * std::abs(t);
    }



    std::string
    component_name(const FieldKind kind, const unsigned int c, const int dim)
    {
      if (kind == FieldKind::vector)
        return direction_name(c);
      if (kind == FieldKind::symmetric_tensor)
        return stress_component_name(c);
      return direction_name(c / dim) + direction_name(c % dim);
    }
  } // namespace



  void
  CheckpointLabel::write(Archive &archive) const
  {
    archive.write("checkpoint/format", format_number);
    archive.write_text("checkpoint/version", version);
    archive.write_text("checkpoint/revision", revision);
    archive.write_text("checkpoint/scene", scene);
    archive.write("checkpoint/dimension", dimension);
    archive.write("checkpoint/step", step);
    archive.write("checkpoint/t", t, "time");
    archive.write("checkpoint/ranks", ranks);
    archive.write_text("checkpoint/parameters", parameters);
  }



  CheckpointLabel
  CheckpointLabel::read(const Archive &archive, const std::string &path)
  {
    if (!archive.contains("checkpoint/format"))
      throw InputError("cannot read '" + path +
                       "': it is no checkpoint of Moraine");
    const unsigned int format = archive.integer("checkpoint/format");
    CheckpointLabel    label;
    label.version = archive.text("checkpoint/version");
    if (format != format_number)
      throw InputError("cannot read '" + path + "': it has format " +
                       std::to_string(format) + ", written by Moraine " +
                       label.version + "; Moraine " +
                       std::string(moraine::version) + " reads format " +
                       std::to_string(format_number) + " only");
    label.revision   = archive.text("checkpoint/revision");
    label.scene      = archive.text("checkpoint/scene");
    label.dimension  = archive.integer("checkpoint/dimension");
    label.step       = archive.integer("checkpoint/step");
    label.t          = archive.number("checkpoint/t");
    label.ranks      = archive.integer("checkpoint/ranks");
    label.parameters = archive.text("checkpoint/parameters");
    return label;
  }



  CheckpointFiles::CheckpointFiles(const std::string &folder,
                                   const MPI_Comm    &communicator)
    : folder((std::filesystem::path(folder) / "checkpoints").string())
    , communicator(communicator)
  {}



  std::string
  CheckpointFiles::path_of(const std::string &name) const
  {
    return (std::filesystem::path(folder) / name).string();
  }



  std::string
  CheckpointFiles::last() const
  {
    std::ifstream file(path_of("last"));
    std::string   name;
    file >> name;
    return name;
  }



  void
  CheckpointFiles::write(const Archive     &archive,
                         const PointFields &fields) const
  {
    std::string slot;
    on_root(communicator, [&]() {
      std::error_code ignored; // opening a file will tell
      std::filesystem::create_directory(folder, ignored);
      slot = last() == "a.h5" ? "b" : "a";
    });
    slot                   = Utilities::MPI::broadcast(communicator, slot);
    const std::string name = slot + ".h5";
    write_file(archive, path_of(name), communicator);
    const std::size_t n_points =
      Utilities::MPI::sum(archive.integers("points/id").size(), communicator);
    on_root(communicator, [&]() {
      write_xdmf(name, path_of(slot + ".xdmf"), archive, fields, n_points);
    });
    make_last(name);
  }



  void
  CheckpointFiles::make_last(const std::string &path) const
  {
    on_root(communicator, [&]() {
      AtomicFile pointer(path_of("last"));
      pointer.stream() << std::filesystem::path(path).filename().string()
                       << '\n';
      pointer.commit();
    });
  }



  std::string
  CheckpointFiles::find(const std::string &from) const
  {
    std::string path;
    on_root(communicator, [&]() { path = find_on_root(from); });
    return Utilities::MPI::broadcast(communicator, path);
  }



  std::string
  CheckpointFiles::find_on_root(const std::string &from) const
  {
    if (last().empty())
      throw InputError("there is no checkpoint: '" + path_of("last") +
                       "' is missing, which a run leaves with 'Checkpoint "
                       "every' in section 'Output', and after Ctrl-C or "
                       "SIGTERM once a step was accepted");
    if (from.empty())
      return path_of(last());
    std::string known;
    for (const char *slot : slots)
      try
        {
          const std::string path  = path_of(slot + std::string(".h5"));
          const auto        label = label_of(path);
          if (is_asked_for(label, from))
            return path;
          known += (known.empty() ? "" : ", ") + in_words(label);
        }
      catch (const InputError &)
        {
          // That one cannot be asked for.
        }
    throw InputError("option '--from': found '" + from + "', allowed: " +
                     (known.empty() ? "nothing that can be read" : known));
  }



  std::string
  CheckpointFiles::others(const std::string &path) const
  {
    for (const char *slot : slots)
      try
        {
          const std::string other = path_of(slot + std::string(".h5"));
          if (other == path)
            continue;
          const auto label = label_of(other);
          return "; the other one, of " + in_words(label) +
                 ", may be good: --from " + std::to_string(label.step);
        }
      catch (const InputError &)
        {
          // There is none.
        }
    return "";
  }



  void
  CheckpointFiles::write_xdmf(const std::string &name,
                              const std::string &path,
                              const Archive     &archive,
                              const PointFields &fields,
                              const std::size_t  n_points) const
  {
    AtomicFile    file(path);
    std::ostream &out = file.stream();
    const auto    set = [&](const std::string &field, const unsigned int n) {
      const bool whole =
        archive.data_sets().at("points/" + field).values.index() == 1;
      std::ostringstream text;
      text << "<DataItem Dimensions=\"" << n_points << ' ' << n
           << "\" NumberType=\"" << (whole ? "UInt" : "Float")
           << "\" Precision=\"" << (whole ? 4 : 8) << "\" Format=\"HDF\">"
           << name << ":/points/" << field << "</DataItem>\n";
      return text.str();
    };
    const auto attribute = [&](const std::string &title,
                               const std::string &type,
                               const std::string &data) {
      out << "<Attribute Name=\"" << title << "\" AttributeType=\"" << type
          << "\" Center=\"Node\">\n"
          << data << "</Attribute>\n";
    };
    const unsigned int dim =
      archive.data_sets().at("points/position").n_components;
    out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\"><Domain>"
        << "<Grid Name=\"points\" GridType=\"Uniform\">\n<Time Value=\""
        << std::setprecision(17) << archive.number("checkpoint/t")
        << "\"/>\n<Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" "
        << "NumberOfElements=\"" << n_points
        << "\"/>\n<Geometry GeometryType=\"" << (dim == 2 ? "XY" : "XYZ")
        << "\">\n"
        << set("position", dim) << "</Geometry>\n";
    attribute("id", "Scalar", set("id", 1));
    for (const auto &field : fields.fields())
      {
        const unsigned int n     = field.n_components;
        const std::string  whole = set(field.name, n);
        const std::string  unit =
          field.unit == "-" ? "" : " [" + field.unit + "]";
        if (n == 1 || (n == 3 && field.kind == FieldKind::vector))
          {
            attribute(field.name + unit, n == 1 ? "Scalar" : "Vector", whole);
            continue;
          }
        for (unsigned int c = 0; c < n; ++c)
          {
            std::ostringstream slab;
            slab << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << n_points
                 << " 1\">\n<DataItem Dimensions=\"3 2\" Format=\"XML\">0 " << c
                 << " 1 1 " << n_points << " 1</DataItem>\n"
                 << whole << "</DataItem>\n";
            attribute(field.name + "_" + component_name(field.kind, c, dim) +
                        unit,
                      "Scalar",
                      slab.str());
          }
      }
    out << "</Grid></Domain></Xdmf>\n";
    file.commit();
  }
} // namespace moraine
