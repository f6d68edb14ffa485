// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/archive.h>

#include <moraine/core/exceptions.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string id_name = "id";

    std::string
    group_of(const std::string &name)
    {
      return name.substr(0, name.rfind('/'));
    }



    template <class T>
    bool
    same_bits(const std::vector<T> &a, const std::vector<T> &b)
    {
      return a.size() == b.size() &&
             (a.empty() ||
              std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
    }



    bool
    same_bits(const std::string &a, const std::string &b)
    {
      return a == b;
    }



    /** The rows of @p values, the first first, in the order of @p rows. */
    template <class T>
    std::vector<T>
    ordered(const std::vector<T>            &values,
            const unsigned int               n_components,
            const std::vector<unsigned int> &rows)
    {
      std::vector<T> result;
      result.reserve(rows.size() * n_components);
      for (const unsigned int row : rows)
        result.insert(result.end(),
                      values.begin() + row * n_components,
                      values.begin() + (row + 1) * n_components);
      return result;
    }



    /** Where the values of each rank begin, for MPI. */
    std::vector<int>
    beginnings(const std::vector<int> &counts)
    {
      std::vector<int> first(counts.size(), 0);
      std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
      return first;
    }



    /** The values of all ranks on rank 0, one rank after the other. deal.II's
     * function packs, which takes longer than to write them to a disk. */
    template <class T>
    std::vector<T>
    gather(const std::vector<T> &values, const MPI_Comm &communicator)
    {
      const std::vector<int> counts =
        Utilities::MPI::all_gather(communicator,
                                   static_cast<int>(values.size()));
      if (counts.size() == 1)
        return values;
      const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
      const auto n =
        std::accumulate(counts.begin(), counts.end(), std::size_t(0));
      std::vector<T>         result(is_root ? n : 0);
      const std::vector<int> first = beginnings(counts);
      const auto             type  = Utilities::MPI::mpi_type_id_for_type<T>;
      MPI_Gatherv(values.data(),
                  values.size(),
                  type,
                  result.data(),
                  counts.data(),
                  first.data(),
                  type,
                  0,
                  communicator);
      return result;
    }



    /** The numbers of rows of @p ids (by @p n each), smallest ids first. */
    std::vector<unsigned int>
    order_of(const std::vector<unsigned int> &ids, const unsigned int n)
    {
      std::vector<unsigned int> rows(ids.size() / n);
      std::iota(rows.begin(), rows.end(), 0u);
      std::sort(rows.begin(),
                rows.end(),
                [&](const unsigned int a, const unsigned int b) {
                  return std::lexicographical_compare(ids.begin() + a * n,
                                                      ids.begin() + (a + 1) * n,
                                                      ids.begin() + b * n,
                                                      ids.begin() +
                                                        (b + 1) * n);
                });
      return rows;
    }



    /** Rank 0's values, or this rank's share of their rows. */
    template <class T>
    std::vector<T>
    scatter(std::vector<T>     values,
            const unsigned int n_components,
            const bool         shared_out,
            const MPI_Comm    &communicator)
    {
      const std::size_t rank  = Utilities::MPI::this_mpi_process(communicator);
      const std::size_t ranks = Utilities::MPI::n_mpi_processes(communicator);
      if (ranks == 1)
        return values;
      const std::size_t size =
        Utilities::MPI::broadcast(communicator, values.size());
      const auto type = Utilities::MPI::mpi_type_id_for_type<T>;
      if (!shared_out)
        {
          values.resize(size);
          MPI_Bcast(values.data(), size, type, 0, communicator);
          return values;
        }
      const std::size_t rows = size / n_components;
      std::vector<int>  counts;
      for (std::size_t r = 0; r < ranks; ++r)
        counts.push_back(((r + 1) * rows / ranks - r * rows / ranks) *
                         n_components);
      const std::vector<int> first = beginnings(counts);
      std::vector<T>         share(counts[rank]);
      MPI_Scatterv(values.data(),
                   counts.data(),
                   first.data(),
                   type,
                   share.data(),
                   share.size(),
                   type,
                   0,
                   communicator);
      return share;
    }



    decltype(Archive::DataSet::values)
    empty_values(const unsigned int kind)
    {
      if (kind == 0)
        return std::vector<double>();
      if (kind == 1)
        return std::vector<unsigned int>();
      return std::string();
    }
  } // namespace



  void
  Archive::add(const std::string &name, DataSet set)
  {
    const bool is_new = sets.emplace(name, std::move(set)).second;
    AssertThrow(is_new, ExcMessage("The archive already has '" + name + "'."));
  }



  void
  Archive::write(const std::string  &name,
                 std::vector<double> values,
                 const unsigned int  n_components,
                 const std::string  &unit)
  {
    AssertThrow(values.size() % n_components == 0, ExcInternalError());
    add(name, {std::move(values), n_components, unit});
  }



  void
  Archive::write(const std::string        &name,
                 std::vector<unsigned int> values,
                 const unsigned int        n_components)
  {
    AssertThrow(values.size() % n_components == 0, ExcInternalError());
    add(name, {std::move(values), n_components, ""});
  }



  void
  Archive::write(const std::string &name,
                 const double       value,
                 const std::string &unit)
  {
    write(name, std::vector<double>{value}, 1, unit);
  }



  void
  Archive::write(const std::string &name, const unsigned int value)
  {
    write(name, std::vector<unsigned int>{value});
  }



  void
  Archive::write_text(const std::string &name, const std::string &text)
  {
    add(name, {text, 1, ""});
  }



  void
  Archive::distribute(const std::string        &group,
                      std::vector<unsigned int> ids,
                      const unsigned int        n_components)
  {
    write(group + "/" + id_name, std::move(ids), n_components);
  }



  template <class T>
  const T &
  Archive::find(const std::string &name, const unsigned int n_components) const
  {
    const auto set = sets.find(name);
    if (set == sets.end())
      throw InputError("archive: it has no data set '" + name + "'");
    const T *values = std::get_if<T>(&set->second.values);
    if (values == nullptr)
      throw InputError("archive: the data set '" + name +
                       "' holds another kind of values");
    if (set->second.n_components != n_components)
      throw InputError(
        "archive: the data set '" + name + "' has " +
        std::to_string(set->second.n_components) +
        " components, expected: " + std::to_string(n_components));
    return *values;
  }



  const std::vector<double> &
  Archive::numbers(const std::string &name,
                   const unsigned int n_components) const
  {
    return find<std::vector<double>>(name, n_components);
  }



  const std::vector<unsigned int> &
  Archive::integers(const std::string &name,
                    const unsigned int n_components) const
  {
    return find<std::vector<unsigned int>>(name, n_components);
  }



  double
  Archive::number(const std::string &name) const
  {
    const auto &values = numbers(name);
    if (values.size() != 1)
      throw InputError("archive: the data set '" + name +
                       "' is not one number");
    return values[0];
  }



  unsigned int
  Archive::integer(const std::string &name) const
  {
    const auto &values = integers(name);
    if (values.size() != 1)
      throw InputError("archive: the data set '" + name +
                       "' is not one integer");
    return values[0];
  }



  void
  Archive::write_lines(const std::string              &name,
                       const std::vector<std::string> &lines)
  {
    std::string text;
    for (const std::string &line : lines)
      text += line + "\n";
    write_text(name, text);
  }



  std::vector<std::string>
  Archive::lines(const std::string &name) const
  {
    std::istringstream       text_of_lines(text(name));
    std::vector<std::string> read_lines;
    for (std::string line; std::getline(text_of_lines, line);)
      read_lines.push_back(line);
    return read_lines;
  }



  const std::string &
  Archive::text(const std::string &name) const
  {
    return find<std::string>(name, 1);
  }



  bool
  Archive::is_distributed(const std::string &name) const
  {
    return contains(group_of(name) + "/" + id_name);
  }



  bool
  Archive::operator==(const Archive &other) const
  {
    return std::equal(
      sets.begin(),
      sets.end(),
      other.sets.begin(),
      other.sets.end(),
      [](const auto &a, const auto &b) {
        return a.first == b.first &&
               a.second.n_components == b.second.n_components &&
               a.second.values.index() == b.second.values.index() &&
               std::visit(
                 [&](const auto &values) {
                   using T = std::decay_t<decltype(values)>;
                   return same_bits(values, std::get<T>(b.second.values));
                 },
                 a.second.values);
      });
  }



  void
  Archive::gather_each(
    const MPI_Comm                                          &communicator,
    const std::function<void(const std::string &, DataSet)> &take) const
  {
    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    std::map<std::string, std::vector<unsigned int>> orders;
    for (const auto &[name, set] : sets)
      if (is_distributed(name) && name == group_of(name) + "/" + id_name)
        orders[group_of(name)] =
          order_of(gather(std::get<std::vector<unsigned int>>(set.values),
                          communicator),
                   set.n_components);

    for (const auto &[name, set] : sets)
      {
        DataSet whole{{}, set.n_components, set.unit};
        std::visit(
          [&, &name = name, &set = set](const auto &values) {
            using T = std::decay_t<decltype(values)>;
            if constexpr (!std::is_same_v<T, std::string>)
              if (is_distributed(name))
                {
                  const auto  all   = gather(values, communicator);
                  const auto &order = orders[group_of(name)];
                  AssertThrow(!is_root ||
                                all.size() == order.size() * set.n_components,
                              ExcMessage("One row for each id: " + name));
                  whole.values = ordered(all, set.n_components, order);
                  return;
                }
            if (is_root)
              whole.values = values;
          },
          set.values);
        take(name, std::move(whole));
      }
  }



  Archive
  Archive::gathered(const MPI_Comm &communicator) const
  {
    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    Archive    whole;
    gather_each(communicator, [&](const std::string &name, DataSet set) {
      if (is_root)
        whole.add(name, std::move(set));
    });
    return whole;
  }



  Archive
  Archive::scattered(const MPI_Comm &communicator) const
  {
    std::vector<std::string> names;
    for (const auto &[name, set] : sets)
      names.push_back(name);
    names = Utilities::MPI::broadcast(communicator, names);

    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    Archive    share;
    for (const std::string &name : names)
      {
        DataSet                   set;
        std::vector<unsigned int> shape(3);
        if (is_root)
          {
            set   = sets.at(name);
            shape = {static_cast<unsigned int>(set.values.index()),
                     set.n_components,
                     is_distributed(name)};
          }
        shape = Utilities::MPI::broadcast(communicator, shape);
        if (!is_root)
          set = {empty_values(shape[0]), shape[1], ""};
        set.unit = Utilities::MPI::broadcast(communicator, set.unit);
        std::visit(
          [&](auto &values) {
            using T = std::decay_t<decltype(values)>;
            if constexpr (std::is_same_v<T, std::string>)
              values = Utilities::MPI::broadcast(communicator, values);
            else
              values = scatter(std::move(values),
                               set.n_components,
                               shape[2] != 0,
                               communicator);
          },
          set.values);
        share.add(name, std::move(set));
      }
    return share;
  }
} // namespace moraine
