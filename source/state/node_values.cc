// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/node_values.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  NodeValuesRecord<dim>::NodeValuesRecord(const GridSpace<dim> &space,
                                          const std::string    &group,
                                          const std::string    &unit)
    : space(space)
    , group(group)
    , unit(unit)
  {
    keep({});
  }



  template <int dim>
  void
  NodeValuesRecord<dim>::keep(const std::vector<Tensor<1, dim>> &values)
  {
    Archive now;
    space.write_node_values(values, group, unit, now);
    stored = std::move(now);
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  NodeValuesRecord<dim>::of_nodes() const
  {
    std::vector<Tensor<1, dim>> values;
    space.read_node_values(stored, group, values);
    return values;
  }



  template <int dim>
  void
  NodeValuesRecord<dim>::read(const Archive &archive)
  {
    Archive found;
    for (const auto &[name, set] : archive.data_sets())
      if (name.rfind(group + "/", 0) == 0)
        found.add(name, set);
    stored = std::move(found);
  }



  template class NodeValuesRecord<2>;
  template class NodeValuesRecord<3>;
} // namespace moraine
