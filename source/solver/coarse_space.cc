// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/coarse_space.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** A mode that is this small once those before are taken out of it is none
     * (rotations on a few nodes). */
    constexpr double dependent = 1e-6;



    /** Orthonormalise vectors of the same length; leave out those that depend
     * on others. */
    std::vector<std::vector<double>>
    basis_of(std::vector<std::vector<double>> vectors)
    {
      std::vector<std::vector<double>> basis;
      const auto                       dot = [](const auto &a, const auto &b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
      };
      for (auto &v : vectors)
        {
          const double before = std::sqrt(dot(v, v));
          // Twice is enough.
          for (unsigned int pass = 0; pass < 2; ++pass)
            for (const auto &b : basis)
              {
                const double c = dot(b, v);
                for (unsigned int i = 0; i < v.size(); ++i)
                  v[i] -= c * b[i];
              }
          const double left = std::sqrt(dot(v, v));
          if (!(left > dependent * before))
            continue;
          for (double &value : v)
            value /= left;
          basis.push_back(v);
        }
      return basis;
    }
  } // namespace



  CoarseSpace::CoarseSpace(const OverlappingRows         &rows,
                           const Subdomains              &subdomains,
                           const std::vector<LA::Vector> &modes,
                           const LA::Vector              &any)
    : rows(rows)
    , subdomains(subdomains)
  {
    const MPI_Comm communicator = any.get_mpi_communicator();
    if (modes.empty())
      {
        std::vector<LA::Vector> constant(1, any);
        constant[0] = 1.;
        make_interface(constant, communicator);
      }
    else
      make_interface(modes, communicator);
    for (unsigned int s = 0; s < subdomains.n_subdomains(); ++s)
      if (Inside inside = continue_into(s); !inside.columns.empty())
        insides.push_back(std::move(inside));
    if (own_columns.size() == 0)
      return;
    make_matrix(communicator);
    solver = std::make_unique<DirectSolver>(matrix);
  }



  void
  CoarseSpace::make_interface(const std::vector<LA::Vector> &modes,
                              const MPI_Comm                &communicator)
  {
    // Parts by the subdomain they belong to and those they border on.
    std::map<std::set<unsigned int>, std::vector<unsigned int>> parts;
    std::set<unsigned int>                                      touched;
    for (unsigned int i = 0; i < rows.n_owned(); ++i)
      {
        const unsigned int own = subdomains.label(i);
        touched.clear();
        for (auto e = rows.begin(i); e < rows.begin(i + 1); ++e)
          if (subdomains.label(rows.column(e)) <= own)
            touched.insert(subdomains.label(rows.column(e)));
        if (touched.size() > 1)
          parts[touched].push_back(i);
      }

    // For each unknown its first column, their number, and values in them.
    std::vector<std::vector<double>> entries(2 + modes.size());
    for (auto &of_all : entries)
      of_all.assign(rows.n_owned(), 0.);
    unsigned int n_columns = 0;
    for (const auto &[labels, unknowns] : parts)
      {
        std::vector<std::vector<double>> restricted(modes.size());
        for (unsigned int m = 0; m < modes.size(); ++m)
          for (const unsigned int i : unknowns)
            restricted[m].push_back(modes[m].trilinos_vector()[0][i]);
        const auto basis = basis_of(std::move(restricted));
        for (unsigned int k = 0; k < unknowns.size(); ++k)
          {
            entries[0][unknowns[k]] = n_columns;
            entries[1][unknowns[k]] = basis.size();
            for (unsigned int c = 0; c < basis.size(); ++c)
              entries[2 + c][unknowns[k]] = basis[c][k];
          }
        n_columns += basis.size();
      }
    own_columns = Utilities::MPI::create_ascending_partitioning(
      communicator, n_columns)[Utilities::MPI::this_mpi_process(communicator)];
    if (n_columns > 0)
      for (double &first : entries[0])
        first += *own_columns.begin();

    interface_of.assign(rows.n_rows(), -1);
    const auto all = rows.import(entries);
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      if (all[1][i] > 0)
        {
          interface_of[i] = interface.size();
          interface.push_back({i, static_cast<unsigned int>(all[0][i]), {}});
          for (unsigned int c = 0; c < all[1][i]; ++c)
            interface.back().values.push_back(all[2 + c][i]);
        }
  }



  CoarseSpace::Inside
  CoarseSpace::continue_into(const unsigned int subdomain) const
  {
    Inside                               inside;
    std::map<unsigned int, unsigned int> numbers; // of columns
    for (const unsigned int i : subdomains.unknowns(subdomain))
      if (!on_interface(i))
        {
          inside.unknowns.push_back(i);
          for (auto e = rows.begin(i); e < rows.begin(i + 1); ++e)
            if (const InterfaceRow *row = on_interface(rows.column(e)))
              for (unsigned int c = 0; c < row->values.size(); ++c)
                numbers.emplace(row->first_column + c, numbers.size());
        }
    inside.columns.resize(numbers.size());
    for (const auto &[column, number] : numbers)
      inside.columns[number] = column;
    if (numbers.empty())
      return Inside();
    const BlockFactors factors = rows.factorise(inside.unknowns);
    if (factors.is_singular())
      return Inside();

    inside.values.reinit(inside.unknowns.size(), numbers.size());
    for (unsigned int k = 0; k < inside.unknowns.size(); ++k)
      for (auto e = rows.begin(inside.unknowns[k]);
           e < rows.begin(inside.unknowns[k] + 1);
           ++e)
        if (const InterfaceRow *row = on_interface(rows.column(e)))
          for (unsigned int c = 0; c < row->values.size(); ++c)
            inside.values(k, numbers.at(row->first_column + c)) -=
              rows.value(e) * row->values[c];
    std::vector<double> column(inside.unknowns.size()), continued;
    for (unsigned int c = 0; c < numbers.size(); ++c)
      {
        for (unsigned int k = 0; k < column.size(); ++k)
          column[k] = inside.values(k, c);
        factors.solve(continued, column);
        for (unsigned int k = 0; k < column.size(); ++k)
          inside.values(k, c) = continued[k];
      }
    return inside;
  }



  FullMatrix<double>
  CoarseSpace::contribution(const Inside &inside) const
  {
    const unsigned int                   n = inside.columns.size();
    std::map<unsigned int, unsigned int> numbers; // of columns
    for (unsigned int c = 0; c < n; ++c)
      numbers.emplace(inside.columns[c], c);
    std::vector<int>       inside_of(rows.n_rows(), -1);
    std::set<unsigned int> border;
    for (unsigned int k = 0; k < inside.unknowns.size(); ++k)
      {
        inside_of[inside.unknowns[k]] = k;
        for (auto e = rows.begin(inside.unknowns[k]);
             e < rows.begin(inside.unknowns[k] + 1);
             ++e)
          if (on_interface(rows.column(e)))
            border.insert(rows.column(e));
      }
    FullMatrix<double>  sum(n, n);
    std::vector<double> product(n);
    for (const unsigned int i : border)
      {
        std::fill(product.begin(), product.end(), 0.);
        for (auto e = rows.begin(i); e < rows.begin(i + 1); ++e)
          if (const int k = inside_of[rows.column(e)]; k >= 0)
            for (unsigned int c = 0; c < n; ++c)
              product[c] += rows.value(e) * inside.values(k, c);
        const InterfaceRow &row = *on_interface(i);
        for (unsigned int r = 0; r < row.values.size(); ++r)
          {
            const unsigned int number = numbers.at(row.first_column + r);
            for (unsigned int c = 0; c < n; ++c)
              sum(number, c) += row.values[r] * product[c];
          }
      }
    return sum;
  }



  void
  CoarseSpace::make_matrix(const MPI_Comm &communicator)
  {
    std::map<std::pair<unsigned int, unsigned int>, double> sums;
    std::map<unsigned int, double> product; // a row of A P
    for (const InterfaceRow &row : interface)
      if (row.row < rows.n_owned())
        {
          product.clear();
          for (auto e = rows.begin(row.row); e < rows.begin(row.row + 1); ++e)
            if (const InterfaceRow *other = on_interface(rows.column(e)))
              for (unsigned int c = 0; c < other->values.size(); ++c)
                product[other->first_column + c] +=
                  rows.value(e) * other->values[c];
          for (unsigned int r = 0; r < row.values.size(); ++r)
            for (const auto &[column, value] : product)
              sums[{row.first_column + r, column}] += row.values[r] * value;
        }
    for (const Inside &inside : insides)
      {
        const FullMatrix<double> block = contribution(inside);
        for (unsigned int r = 0; r < block.m(); ++r)
          for (unsigned int c = 0; c < block.n(); ++c)
            sums[{inside.columns[r], inside.columns[c]}] += block(r, c);
      }
    LA::SparsityPattern pattern(own_columns, communicator);
    for (const auto &[where, value] : sums)
      pattern.add(where.first, where.second);
    pattern.compress();
    matrix.reinit(pattern);
    for (const auto &[where, value] : sums)
      matrix.add(where.first, where.second, value);
    matrix.compress(VectorOperation::add);

    IndexSet known_columns = own_columns;
    for (const InterfaceRow &row : interface)
      known_columns.add_range(row.first_column,
                              row.first_column + row.values.size());
    right_hand_side.reinit(own_columns, communicator);
    solution.reinit(own_columns, communicator);
    known.reinit(own_columns, known_columns, communicator);
  }



  void
  CoarseSpace::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    dst = 0.;
    if (solver == nullptr)
      return;
    const double *source = src.trilinos_vector()[0];
    double       *target = dst.trilinos_vector()[0];
    right_hand_side      = 0.;
    for (const InterfaceRow &row : interface)
      if (row.row < rows.n_owned())
        for (unsigned int c = 0; c < row.values.size(); ++c)
          right_hand_side(row.first_column + c) +=
            row.values[c] * source[row.row];
    dealii::Vector<double> values, products;
    for (const Inside &inside : insides)
      {
        values.reinit(inside.unknowns.size(), true);
        products.reinit(inside.columns.size(), true);
        for (unsigned int k = 0; k < values.size(); ++k)
          values[k] = source[inside.unknowns[k]];
        inside.values.Tvmult(products, values);
        right_hand_side.add(inside.columns, products);
      }
    right_hand_side.compress(VectorOperation::add);
    solver->solve(solution, right_hand_side);
    known = solution;
    for (const InterfaceRow &row : interface)
      if (row.row < rows.n_owned())
        for (unsigned int c = 0; c < row.values.size(); ++c)
          target[row.row] += row.values[c] * known(row.first_column + c);
    for (const Inside &inside : insides)
      {
        values.reinit(inside.unknowns.size(), true);
        products.reinit(inside.columns.size(), true);
        for (unsigned int c = 0; c < products.size(); ++c)
          products[c] = known(inside.columns[c]);
        inside.values.vmult(values, products);
        for (unsigned int k = 0; k < values.size(); ++k)
          target[inside.unknowns[k]] += values[k];
      }
  }
} // namespace moraine
