// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/points/moment_fitting.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Relative residual of the moments. */
    constexpr double tolerance_of_moments = 1e-13;

    /** Call @p action(vertices) for simplices that make up the polytope. */
    template <int dim, typename Action>
    void
    for_each_simplex(const ConvexPolytope<dim> &polytope, const Action &action)
    {
      polytope.for_each_face([&](const auto &loop) {
        for (unsigned int i = 1; i + 1 < loop.size(); ++i)
          if constexpr (dim == 2)
            action(std::array<Point<2>, 3>{{loop[0], loop[i], loop[i + 1]}});
          else
            action(std::array<Point<3>, 4>{
              {polytope.vertices()[0], loop[0], loop[i], loop[i + 1]}});
      });
    }



    /** The volume of a simplex; negative if it is turned over. */
    template <int dim>
    double
    volume_of(const std::array<Point<dim>, dim + 1> &x)
    {
      Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = x[d + 1] - x[0];
      return determinant(edges) / (dim == 2 ? 2. : 6.);
    }



    /** Products of Chebyshev's polynomials on a box. */
    template <int dim>
    class Polynomials
    {
    public:
      Polynomials(const BoundingBox<dim> &box, const unsigned int degree)
        : box(box)
        , degree(degree)
      {}

      unsigned int
      size() const
      {
        return Utilities::pow(degree + 1, dim);
      }

      Vector<double>
      values(const Point<dim> &x) const
      {
        Vector<double> values(size());
        values[0]           = 1.;
        unsigned int stride = 1;
        for (unsigned int d = 0; d < dim; ++d, stride *= degree + 1)
          {
            const double xi =
              2. * (x[d] - box.lower_bound(d)) / box.side_length(d) - 1.;
            for (unsigned int k = 1; k <= degree; ++k)
              for (unsigned int i = 0; i < stride; ++i)
                values[k * stride + i] =
                  k == 1 ? xi * values[i] :
                           2. * xi * values[(k - 1) * stride + i] -
                             values[(k - 2) * stride + i];
          }
        return values;
      }

    private:
      const BoundingBox<dim> box;
      const unsigned int     degree;
    };



    /** Weights >= 0 of the columns with which they sum up to b in the sense of
     * least squares; at most as many as b has entries are not zero. */
    class NonnegativeLeastSquares
    {
    public:
      NonnegativeLeastSquares(const std::vector<Vector<double>> &columns,
                              const Vector<double>              &b)
        : columns(columns)
        , b(b)
        , weights(columns.size(), 0.)
        , residual(b)
      {}

      /** Whether the residual vanishes. */
      bool
      solve()
      {
        // Each column enters about once; ten times as many steps are a failure.
        for (unsigned int n = 0; n < 10 * b.size(); ++n)
          {
            if (residual.l2_norm() <= tolerance_of_moments * b.l2_norm())
              return true;
            unsigned int best     = 0;
            double       steepest = 0.;
            for (unsigned int j = 0; j < columns.size(); ++j)
              if (weights[j] == 0. && columns[j] * residual > steepest)
                {
                  best     = j;
                  steepest = columns[j] * residual;
                }
            if (steepest == 0. || chosen.size() == b.size())
              return false;
            chosen.push_back(best);
            for (;;)
              {
                const Vector<double> z = unconstrained();
                if (std::all_of(z.begin(), z.end(), [](const double w) {
                      return w > 0.;
                    }))
                  {
                    for (unsigned int j = 0; j < chosen.size(); ++j)
                      weights[chosen[j]] = z[j];
                    break;
                  }
                step_towards(z);
                if (chosen.empty())
                  return false;
              }
            residual = b;
            for (const unsigned int j : chosen)
              residual.add(-weights[j], columns[j]);
          }
        return false;
      }

      const std::vector<Vector<double>> &columns;
      const Vector<double>              &b;
      std::vector<double>                weights;

    private:
      /** The unconstrained solution with the chosen columns. */
      Vector<double>
      unconstrained() const
      {
        FullMatrix<double> matrix(b.size(), chosen.size());
        for (unsigned int j = 0; j < chosen.size(); ++j)
          for (unsigned int i = 0; i < b.size(); ++i)
            matrix(i, j) = columns[chosen[j]][i];
        Vector<double> z(chosen.size());
        Householder<double>(matrix).least_squares(z, b);
        return z;
      }

      /** Go towards @p z until a weight vanishes, and drop its column. */
      void
      step_towards(const Vector<double> &z)
      {
        double       length = 1.;
        unsigned int first  = 0;
        for (unsigned int j = 0; j < chosen.size(); ++j)
          {
            const double x = weights[chosen[j]];
            if (z[j] <= 0. && x / (x - z[j]) <= length)
              {
                length = x / (x - z[j]);
                first  = j;
              }
          }
        for (unsigned int j = 0; j < chosen.size(); ++j)
          weights[chosen[j]] += length * (z[j] - weights[chosen[j]]);
        weights[chosen[first]] = 0.;
        chosen.erase(chosen.begin() + first);
      }

      std::vector<unsigned int> chosen;
      Vector<double>            residual;
    };



  } // namespace



  template <int dim>
  Quadrature<dim>
  moment_fitted_rule(const std::vector<SignedPiece<dim>> &pieces,
                     const Shape<dim>                    &shape,
                     const double                         volume,
                     const unsigned int                   degree)
  {
    std::vector<Point<dim>> corners;
    for (const auto &piece : pieces)
      if (piece.sign > 0.)
        corners.insert(corners.end(),
                       piece.polytope.vertices().begin(),
                       piece.polytope.vertices().end());
    if (corners.empty())
      return Quadrature<dim>();

    // Exact for the total degree of a product of dim polynomials.
    const Quadrature<dim> rule =
      QWitherdenVincentSimplex<dim>((dim * degree + 2) / 2);
    const Polynomials<dim> polynomials(BoundingBox<dim>(corners), degree);
    // The tip lies in some of the faces.
    const double flat = 1e-14 * volume;
    // Enough candidates, of curved shapes with many pieces not all.
    const std::size_t every =
      pieces.size() * rule.size() / (40 * polynomials.size()) + 1;
    std::size_t                 n_seen = 0;
    std::vector<Point<dim>>     candidates;
    std::vector<Vector<double>> columns;
    Vector<double>              moments(polynomials.size());
    for (const auto &piece : pieces)
      for_each_simplex<dim>(piece.polytope, [&](const auto &simplex) {
        const double size = volume_of<dim>(simplex);
        if (size <= flat)
          return;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point<dim> x = simplex[0];
            for (unsigned int d = 0; d < dim; ++d)
              x += rule.point(q)[d] * (simplex[d + 1] - simplex[0]);
            const Vector<double> values = polynomials.values(x);
            moments.add(piece.sign * size * (dim == 2 ? 2. : 6.) *
                          rule.weight(q),
                        values);
            if (piece.sign > 0. && n_seen++ % every == 0 && shape.contains(x))
              {
                candidates.push_back(x);
                columns.push_back(values);
              }
          }
      });
    // A curved shape knows its volume better than its pieces do.
    moments *= volume / moments[0];

    NonnegativeLeastSquares fit(columns, moments);
    if (!fit.solve())
      return Quadrature<dim>();
    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    for (unsigned int j = 0; j < columns.size(); ++j)
      if (fit.weights[j] > 0.)
        {
          points.push_back(candidates[j]);
          weights.push_back(fit.weights[j]);
        }
    return Quadrature<dim>(points, weights);
  }



  template decltype(moment_fitted_rule<2>) moment_fitted_rule<2>;
  template decltype(moment_fitted_rule<3>) moment_fitted_rule<3>;
} // namespace moraine
