// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// HDF5 files of archives. deal.II's classes for HDF5 check calls in Debug
// builds only and know no texts; a full disk must be noticed always.

#include <moraine/core/archive.h>

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/config.h>

#include <deal.II/base/mpi.h>

#include <functional>

#ifdef DEAL_II_WITH_HDF5
#  include <hdf5.h>
#endif

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



#ifdef DEAL_II_WITH_HDF5
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



    void
    write_array(const hid_t                 file,
                const std::string          &name,
                const hid_t                 type,
                const std::vector<hsize_t> &size,
                const void                 *values)
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
    }



    void
    write_set(const hid_t             file,
              const std::string      &name,
              const Archive::DataSet &set)
    {
      if (const auto *text = std::get_if<std::string>(&set.values))
        {
          // HDF5 has no texts of length 0.
          const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
          check(H5Tset_size(type, text->size() + 1));
          check(H5Tset_cset(type, H5T_CSET_UTF8));
          write_array(file, name, type, {1}, text->c_str());
          return;
        }
      const auto write = [&](const auto &values) {
        write_array(file,
                    name,
                    type_of(values),
                    {values.size() / set.n_components, set.n_components},
                    values.data());
      };
      if (const auto *numbers = std::get_if<std::vector<double>>(&set.values))
        write(*numbers);
      else
        write(std::get<std::vector<unsigned int>>(set.values));
    }



    /** The bytes of the file. HDF5 does not recover if a disk is full while it
     * writes, so it writes to memory. */
    std::vector<char>
    file_of(const Archive &archive)
    {
      const Silence silence;
      const Handle  in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      check(H5Pset_fapl_core(in_memory, 1 << 20, 0));
      const Handle file(
        H5Fcreate("archive", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose);
      for (const auto &[name, set] : archive.data_sets())
        write_set(file, name, set);
      check(H5Fflush(file, H5F_SCOPE_GLOBAL));
      std::vector<char> bytes(check(H5Fget_file_image(file, nullptr, 0)));
      check(H5Fget_file_image(file, bytes.data(), bytes.size()));
      return bytes;
    }



    template <class T>
    std::vector<T>
    read_array(const hid_t set, const std::size_t size)
    {
      std::vector<T> values(size);
      check(H5Dread(
        set, type_of(values), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      return values;
    }



    void
    read_set(const hid_t file, const std::string &name, Archive &archive)
    {
      const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle type(H5Dget_type(set), H5Tclose);
      const Handle space(H5Dget_space(set), H5Sclose);
      const H5T_class_t kind = H5Tget_class(type);
      if (kind == H5T_STRING)
        {
          std::string text(H5Tget_size(type), '\0');
          check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &text[0]));
          text.pop_back();
          archive.write_text(name, text);
          return;
        }
      hsize_t size[2];
      if (H5Sget_simple_extent_ndims(space) != 2)
        throw InputError("the data set '" + name + "' is not a table");
      check(H5Sget_simple_extent_dims(space, size, nullptr));
      if (kind == H5T_FLOAT)
        archive.write(name,
                      read_array<double>(set, size[0] * size[1]),
                      size[1]);
      else
        archive.write(name,
                      read_array<unsigned int>(set, size[0] * size[1]),
                      size[1]);
    }



    herr_t
    note_set(hid_t, const char *name, const H5O_info_t *info, void *names)
    {
      if (info->type == H5O_TYPE_DATASET)
        static_cast<std::vector<std::string> *>(names)->emplace_back(name);
      return 0;
    }



    Archive
    read_whole(const std::string &path)
    {
      const Silence silence;
      const Handle  file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                        H5Fclose);
      std::vector<std::string> names;
      check(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, &note_set, &names));
      Archive archive;
      for (const std::string &name : names)
        read_set(file, name, archive);
      return archive;
    }
#else
    std::vector<char>
    file_of(const Archive &)
    {
      throw InputError("deal.II was built without HDF5");
    }



    Archive
    read_whole(const std::string &)
    {
      throw InputError("deal.II was built without HDF5");
    }
#endif
  } // namespace



  void
  write_file(const Archive     &archive,
             const std::string &path,
             const MPI_Comm    &communicator)
  {
    const Archive whole = archive.gathered(communicator);
    on_first_rank(communicator, [&]() {
      const std::vector<char> bytes = file_of(whole);
      AtomicFile              file(path);
      file.stream().write(bytes.data(), bytes.size());
      file.commit();
    });
  }



  Archive
  read_file(const std::string &path, const MPI_Comm &communicator)
  {
    Archive whole;
    on_first_rank(communicator, [&]() {
      try
        {
          whole = read_whole(path);
        }
      catch (const std::exception &error)
        {
          throw InputError("cannot read '" + path + "': " + error.what());
        }
    });
    return whole.scattered(communicator);
  }
} // namespace moraine
