// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// HDF5 files of archives. deal.II's classes for HDF5 check calls in Debug
// builds only and know no texts; a full disk must be noticed always.

#include <moraine/core/archive.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Let rank 0 work, and all ranks throw what it throws. */
    void
    on_first_rank(const MPI_Comm &communicator, const std::function<void()> &f)
    {
      std::string message;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        try
          {
            f();
          }
        catch (const std::exception &error)
          {
            message = error.what();
          }
      message = Utilities::MPI::broadcast(communicator, message);
      if (!message.empty())
        throw InputError(message);
    }



    template <class T>
    T
    check(const T result)
    {
      if (result < 0)
        throw InputError("HDF5 reports a failure");
      return result;
    }



    /** An object of HDF5, closed at the end of its life. */
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id(check(id))
        , close(close)
      {}

      ~Handle()
      {
        close(id);
      }

      Handle(const Handle &) = delete;

      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };



    /** Keeps HDF5 from printing; we throw. */
    class Silence
    {
    public:
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~Silence()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

    private:
      H5E_auto2_t function;
      void       *data;
    };



    /** Of the bytes of @p size values; any change of one of them shows. */
    std::string
    checksum_of(const void *values, const std::size_t size)
    {
      constexpr std::uint64_t prime = 0x9e3779b97f4a7c15;
      std::uint64_t           sum = size, word = 0;
      const auto             *bytes = static_cast<const char *>(values);
      for (std::size_t i = 0; i < size; i += sizeof(word), word = 0)
        {
          std::memcpy(&word, bytes + i, std::min(sizeof(word), size - i));
          sum = (sum ^ word) * prime;
          sum ^= sum >> 32;
        }
      return fmt::format("{:x}", sum);
    }



    std::string
    checksum_of(const std::string &text)
    {
      return checksum_of(text.data(), text.size());
    }



    template <class T>
    std::string
    checksum_of(const std::vector<T> &values)
    {
      return checksum_of(values.data(), values.size() * sizeof(T));
    }



    hid_t
    type_of(const std::vector<double> &)
    {
      return H5T_NATIVE_DOUBLE;
    }



    hid_t
    type_of(const std::vector<unsigned int> &)
    {
      return H5T_NATIVE_UINT;
    }



    /** HDF5 has no texts of length 0: all end with a zero. */
    hid_t
    type_of(const std::string &text)
    {
      const hid_t type = check(H5Tcopy(H5T_C_S1));
      check(H5Tset_size(type, text.size() + 1));
      check(H5Tset_cset(type, H5T_CSET_UTF8));
      return type;
    }



    void
    write_attribute(const hid_t        set,
                    const std::string &name,
                    const std::string &text)
    {
      const Handle type(type_of(text), H5Tclose);
      const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
      const Handle attribute(
        H5Acreate2(set, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
      check(H5Awrite(attribute, type, text.c_str()));
    }



    std::string
    read_attribute(const hid_t set, const std::string &name)
    {
      const Handle attribute(H5Aopen(set, name.c_str(), H5P_DEFAULT), H5Aclose);
      const Handle type(H5Aget_type(attribute), H5Tclose);
      std::string  text(H5Tget_size(type), '\0');
      check(H5Aread(attribute, type, &text[0]));
      text.pop_back();
      return text;
    }



    void
    write_array(const hid_t                 file,
                const std::string          &name,
                const hid_t                 type,
                const std::vector<hsize_t> &size,
                const void                 *values,
                const std::string          &unit,
                const std::string          &checksum)
    {
      const Handle make_groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
      check(H5Pset_create_intermediate_group(make_groups, 1));
      const Handle space(H5Screate_simple(size.size(), size.data(), nullptr),
                         H5Sclose);
      const Handle set(H5Dcreate2(file,
                                  name.c_str(),
                                  type,
                                  space,
                                  make_groups,
                                  H5P_DEFAULT,
                                  H5P_DEFAULT),
                       H5Dclose);
      check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
      if (!unit.empty())
        write_attribute(set, "unit", unit);
      write_attribute(set, "checksum", checksum);
    }



    void
    write_set(const hid_t             file,
              const std::string      &name,
              const Archive::DataSet &set)
    {
      if (const auto *text = std::get_if<std::string>(&set.values))
        {
          const Handle type(type_of(*text), H5Tclose);
          write_array(
            file, name, type, {1}, text->c_str(), set.unit, checksum_of(*text));
          return;
        }
      const auto write = [&](const auto &values) {
        write_array(file,
                    name,
                    type_of(values),
                    {values.size() / set.n_components, set.n_components},
                    values.data(),
                    set.unit,
                    checksum_of(values));
      };
      if (const auto *numbers = std::get_if<std::vector<double>>(&set.values))
        write(*numbers);
      else
        write(std::get<std::vector<unsigned int>>(set.values));
    }



    /** A file in memory: HDF5 does not recover if a disk is full while it
     * writes. */
    class FileInMemory
    {
    public:
      /** For about so many bytes. */
      FileInMemory(const std::size_t bytes)
        : access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose)
        , file(create(bytes, access), H5Fclose)
      {}

      void
      add(const std::string &name, const Archive::DataSet &set)
      {
        write_set(file, name, set);
      }

      void
      write(std::ostream &out) const
      {
        check(H5Fflush(file, H5F_SCOPE_GLOBAL));
        std::vector<char> bytes(check(H5Fget_file_image(file, nullptr, 0)));
        check(H5Fget_file_image(file, bytes.data(), bytes.size()));
        out.write(bytes.data(), bytes.size());
      }

    private:
      static hid_t
      create(const std::size_t bytes, const hid_t access)
      {
        // Memory grows by pieces that are filled with zeros first.
        constexpr std::size_t least = 1 << 16;
        check(H5Pset_fapl_core(access, std::max(least, bytes / 4), 0));
        return H5Fcreate("archive", H5F_ACC_TRUNC, H5P_DEFAULT, access);
      }

      const Silence silence;
      const Handle  access, file;
    };



    template <class T>
    std::vector<T>
    read_array(const hid_t set, const std::size_t size)
    {
      std::vector<T> values(size);
      check(H5Dread(
        set, type_of(values), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      return values;
    }



    /** @throws InputError unless @p values are those that were written. */
    template <class Values>
    Values
    intact(const hid_t set, const std::string &name, Values values)
    {
      if (read_attribute(set, "checksum") != checksum_of(values))
        throw InputError("the data set '" + name +
                         "' is damaged: its checksum is another");
      return values;
    }



    Archive::DataSet
    read_set(const hid_t file, const std::string &name)
    {
      const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle type(H5Dget_type(set), H5Tclose);
      const Handle space(H5Dget_space(set), H5Sclose);
      const H5T_class_t kind = H5Tget_class(type);
      const std::string unit = check(H5Aexists(set, "unit")) > 0 ?
                                 read_attribute(set, "unit") :
                                 std::string();
      if (kind == H5T_STRING)
        {
          std::string text(H5Tget_size(type), '\0');
          check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text[0]));
          text.pop_back();
          return {intact(set, name, std::move(text)), 1, unit};
        }
      hsize_t size[2];
      if (H5Sget_simple_extent_ndims(space) != 2)
        throw InputError("the data set '" + name + "' is not a table");
      check(H5Sget_simple_extent_dims(space, size, nullptr));
      const std::size_t  n            = size[0] * size[1];
      const unsigned int n_components = size[1];
      if (kind == H5T_FLOAT)
        return {intact(set, name, read_array<double>(set, n)),
                n_components,
                unit};
      return {intact(set, name, read_array<unsigned int>(set, n)),
              n_components,
              unit};
    }



    /** @throws InputError with the cause if there is no HDF5 file. */
    hid_t
    open_file(const std::string &path)
    {
      errno            = 0;
      const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      if (file >= 0)
        return file;
      if (!std::ifstream(path))
        throw InputError(std::strerror(errno));
      throw InputError("it is no HDF5 file or not all of it");
    }



    herr_t
    note_set(hid_t, const char *name, const H5O_info_t *info, void *names)
    {
      if (info->type == H5O_TYPE_DATASET)
        static_cast<std::vector<std::string> *>(names)->emplace_back(name);
      return 0;
    }



    /** Take the data sets of the file whose names begin with @p start. */
    template <class Take>
    void
    read_sets(const std::string &path,
              const std::string &start,
              const Take        &take)
    {
      const Silence            silence;
      const Handle             file(open_file(path), H5Fclose);
      std::vector<std::string> names;
      check(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, &note_set, &names));
      for (const std::string &name : names)
        if (name.compare(0, start.size(), start) == 0)
          take(name, read_set(file, name));
    }



    /** Add what read_sets() finds, or say why that cannot be. */
    Archive
    read_whole(const std::string &path, const std::string &start)
    {
      Archive archive;
      try
        {
          read_sets(path,
                    start,
                    [&](const std::string &name, Archive::DataSet set) {
                      archive.add(name, std::move(set));
                    });
        }
      catch (const std::exception &error)
        {
          throw InputError("cannot read '" + path + "': " + error.what());
        }
      return archive;
    }



    /** Of the values of this rank. */
    std::size_t
    bytes_of(const Archive &archive)
    {
      std::size_t bytes = 0;
      for (const auto &[name, set] : archive.data_sets())
        bytes += std::visit(
          [](const auto &values) {
            return values.size() * sizeof(*values.data());
          },
          set.values);
      return bytes;
    }



    /** Bring the closed file @p path to the disk and see that it is good. */
    void
    verify(const std::string &path)
    {
      const int  file    = open(path.c_str(), O_RDONLY);
      const bool on_disk = file >= 0 && fsync(file) == 0;
      if (file >= 0)
        close(file);
      if (!on_disk)
        throw InputError(path + ": cannot be brought to the disk");
      read_sets(path, "", [](const std::string &, const Archive::DataSet &) {});
    }
  } // namespace



  void
  write_file(const Archive     &archive,
             const std::string &path,
             const MPI_Comm    &communicator)
  {
    std::unique_ptr<FileInMemory> in_memory;
    on_first_rank(communicator, [&]() {
      in_memory = std::make_unique<FileInMemory>(bytes_of(archive));
    });
    // All ranks take part to the end, whatever fails on the first.
    std::exception_ptr failure;
    archive.gather_each(communicator,
                        [&](const std::string &name, Archive::DataSet set) {
                          try
                            {
                              if (in_memory && !failure)
                                in_memory->add(name, set);
                            }
                          catch (...)
                            {
                              failure = std::current_exception();
                            }
                        });
    on_first_rank(communicator, [&]() {
      if (failure)
        std::rethrow_exception(failure);
      AtomicFile file(path);
      in_memory->write(file.stream());
      in_memory.reset();
      file.commit(&verify);
    });
  }



  Archive
  read_file(const std::string &path, const MPI_Comm &communicator)
  {
    Archive whole;
    on_first_rank(communicator, [&]() { whole = read_whole(path, ""); });
    return whole.scattered(communicator);
  }



  Archive
  read_group(const std::string &path, const std::string &group)
  {
    return read_whole(path, group + "/");
  }
} // namespace moraine
