// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/last_increment.h>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string group = "path/increment";
  }



  template <int dim>
  LastIncrement<dim>::LastIncrement(const GridSpace<dim> &space)
    : space(space)
  {
    keep({});
  }



  template <int dim>
  void
  LastIncrement<dim>::keep(const std::vector<Tensor<1, dim>> &increments)
  {
    Archive now;
    space.write_node_values(increments, group, "length", now);
    stored = std::move(now);
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  LastIncrement<dim>::of_nodes() const
  {
    std::vector<Tensor<1, dim>> increments;
    space.read_node_values(stored, group, increments);
    return increments;
  }



  template <int dim>
  void
  LastIncrement<dim>::read(const Archive &archive)
  {
    Archive found;
    for (const auto &[name, set] : archive.data_sets())
      if (name.rfind(group + "/", 0) == 0)
        found.add(name, set);
    stored = std::move(found);
  }



  template class LastIncrement<2>;
  template class LastIncrement<3>;
} // namespace moraine
