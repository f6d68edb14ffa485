// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/error_norms.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>
#include <moraine/output/component_names.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What is below this part of the largest value is zero but for round-off.
     */
    constexpr double negligible_norm = 1e-12;

    /**
     * One quantity of all local points: its exact size, the size of its error,
     * and the volume it stands for.
     */
    struct Sample
    {
      std::vector<double> volume;
      std::vector<double> exact;
      std::vector<double> error;

      void
      add(const double v, const double exact_size, const double error_size)
      {
        volume.push_back(v);
        exact.push_back(exact_size);
        error.push_back(error_size);
      }
    };

    double
    largest(const std::vector<double> &values, const MPI_Comm &communicator)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, value);
      return Utilities::MPI::max(result, communicator);
    }

    /** Sum over all points of @p upper over that of @p lower, functions of the
     * exact size and that of the error, weighted by volumes. */
    template <typename Upper, typename Lower>
    double
    ratio_of_sums(const Sample   &sample,
                  const MPI_Comm &communicator,
                  const Upper    &upper,
                  const Lower    &lower)
    {
      double sums[2] = {0., 0.};
      for (std::size_t p = 0; p < sample.volume.size(); ++p)
        {
          sums[0] += sample.volume[p] * upper(sample.exact[p], sample.error[p]);
          sums[1] += sample.volume[p] * lower(sample.exact[p]);
        }
      Utilities::MPI::sum(ArrayView<const double>(sums, 2),
                          communicator,
                          ArrayView<double>(sums, 2));
      return sums[0] / sums[1];
    }

    constexpr auto one = [](const double) { return 1.; };

    /** Volume-weighted mean of the relative errors of the points. */
    double
    mean_relative_error(const Sample   &sample,
                        const double    largest_exact,
                        const MPI_Comm &communicator)
    {
      const auto relative = [&](const double exact, const double error) {
        return error / (exact > negligible_norm * largest_exact ?
                          exact :
                          largest_exact);
      };
      return ratio_of_sums(sample, communicator, relative, one);
    }

    double
    relative_l2_error(const Sample &sample, const MPI_Comm &communicator)
    {
      return std::sqrt(ratio_of_sums(
        sample,
        communicator,
        [](const double, const double error) { return error * error; },
        [](const double exact) { return exact * exact; }));
    }

    /** Frobenius norm of a stress given by its stored components. */
    template <int dim>
    double
    norm(const typename ExactSolution<dim>::Stress &stress)
    {
      double square = 0;
      for (unsigned int c = 0; c < stress.size(); ++c)
        square += (c < 3 ? 1. : 2.) * stress[c] * stress[c];
      return std::sqrt(square);
    }

    /** The points at a time, and what is exact there. */
    template <int dim>
    struct Comparison
    {
      const PointSet<dim>      &points;
      const ExactSolution<dim> &exact;
      const double              time;
      const bool                points_moved;
      const MPI_Comm            communicator =
        points.mesh().triangulation().get_communicator();
      const PointField<dim, double> initial_volume =
        points.fields().find(FieldNames<dim>::initial_volume);

      /** @f$v_0@f$; at small strain that is the volume. */
      double
      volume(const unsigned int p) const
      {
        return initial_volume.exists() ? initial_volume(points.values(p)) :
                                         points.volume(p);
      }

      Tensor<1, dim>
      displacement(const unsigned int p) const
      {
        return points.displacement_field()(points.values(p));
      }

      Point<dim>
      start(const unsigned int p) const
      {
        return points_moved ? points.position(p) - displacement(p) :
                              points.position(p);
      }
    };

    template <int dim>
    void
    add_displacement_errors(const Comparison<dim> &of, ErrorNorms &norms)
    {
      Sample sample;
      for (unsigned int p = 0; p < of.points.n_local(); ++p)
        {
          const Tensor<1, dim> exact =
            of.exact.displacement(of.start(p), of.time);
          sample.add(of.volume(p),
                     exact.norm(),
                     (of.displacement(p) - exact).norm());
        }

      const double          scale = largest(sample.exact, of.communicator);
      std::optional<double> relative, l2;
      if (scale > 0)
        {
          relative = mean_relative_error(sample, scale, of.communicator);
          l2       = relative_l2_error(sample, of.communicator);
        }
      norms.emplace_back("r_u", relative);
      norms.emplace_back("l2_u", l2);
      norms.emplace_back("max_u", largest(sample.error, of.communicator));
    }

    template <int dim>
    void
    add_stress_errors(const Comparison<dim> &of, ErrorNorms &norms)
    {
      constexpr unsigned int n = n_stress_components<dim>;
      std::array<Sample, n>  components;
      Sample                 whole;
      for (unsigned int p = 0; p < of.points.n_local(); ++p)
        {
          const auto stress = of.exact.stress(of.start(p), of.time);
          auto       error  = stress;
          for (unsigned int c = 0; c < n; ++c)
            {
              error[c] -= of.points.values(p)[of.points.stress_offset() + c];
              components[c].add(of.volume(p),
                                std::abs(stress[c]),
                                std::abs(error[c]));
            }
          whole.add(of.volume(p), norm<dim>(stress), norm<dim>(error));
        }

      const double scale = largest(whole.exact, of.communicator);
      for (unsigned int c = 0; c < n; ++c)
        {
          const double component_scale =
            largest(components[c].exact, of.communicator);
          std::optional<double> relative;
          if (component_scale > negligible_norm * scale)
            relative = mean_relative_error(components[c],
                                           component_scale,
                                           of.communicator);
          norms.emplace_back("r_sigma_" + stress_component_name(c), relative);
        }
      std::optional<double> l2;
      if (scale > 0)
        l2 = relative_l2_error(whole, of.communicator);
      const auto size = [](const double, const double error) { return error; };
      norms.emplace_back("l2_sigma", l2);
      norms.emplace_back("mean_sigma",
                         ratio_of_sums(whole, of.communicator, size, one));
      norms.emplace_back("max_sigma", largest(whole.error, of.communicator));
    }
  } // namespace



  template <int dim>
  void
  ExactSolutionParameters<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Displacement",
      displacement,
      dim == 2 ? "Exact displacement, 'u_x; u_y' as expressions in x, y, t; x "
                 "and y are where the material was at the start [length]." :
                 "Exact displacement, 'u_x; u_y; u_z' as expressions in x, y, "
                 "z, t; x, y and z are where the material was at the start "
                 "[length].");
    prm.add_parameter(
      "Stress",
      stress,
      dim == 2 ? "Exact stress, 'sigma_xx; sigma_yy; sigma_zz; sigma_xy' as "
                 "expressions in x, y, t [stress]." :
                 "Exact stress, 'sigma_xx; sigma_yy; sigma_zz; sigma_xy; "
                 "sigma_xz; sigma_yz' as expressions in x, y, z, t [stress].");
    prm.add_parameter("Constants",
                      constants,
                      "Names for numbers in these expressions: 'c: 0.866, "
                      "s: 0.5'.");
  }



  template <int dim>
  ExactSolution<dim>
  ExactSolutionParameters<dim>::solution() const
  {
    const std::string  section = "Exact solution";
    ExactSolution<dim> exact;
    if (!displacement.empty())
      exact.displacement = [u = Expression<dim>(displacement,
                                                place(section, "Displacement"),
                                                dim,
                                                constants)](const Point<dim> &x,
                                                            const double t) {
        return u.vector_value(x, t);
      };
    if (!stress.empty())
      exact.stress = [sigma = Expression<dim>(stress,
                                              place(section, "Stress"),
                                              n_stress_components<dim>,
                                              constants)](const Point<dim> &x,
                                                          const double      t) {
        typename ExactSolution<dim>::Stress values;
        for (unsigned int c = 0; c < values.size(); ++c)
          values[c] = sigma.value(x, t, c);
        return values;
      };
    return exact;
  }



  template <int dim>
  ErrorNorms
  error_norms(const PointSet<dim>      &points,
              const ExactSolution<dim> &exact,
              const double              time,
              const bool                points_moved)
  {
    const Comparison<dim> comparison{points, exact, time, points_moved};
    ErrorNorms            norms;
    if (exact.displacement)
      add_displacement_errors(comparison, norms);
    if (exact.stress)
      add_stress_errors(comparison, norms);
    return norms;
  }



#define INSTANTIATE(dim)                        \
  template struct ExactSolutionParameters<dim>; \
  template decltype(error_norms<dim>) error_norms<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
