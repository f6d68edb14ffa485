// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/boundary/contact_boundary.h>

#include <gtest/gtest.h>

#include <random>

using namespace moraine;
using dealii::Tensor;

namespace
{
  template <int dim>
  Tensor<1, dim>
  any_vector(std::mt19937 &generator)
  {
    std::normal_distribution<> normal;
    Tensor<1, dim>             v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = normal(generator);
    return v;
  }



  template <int dim>
  void
  check_random_tractions()
  {
    constexpr double mu = 0.3, c = 2, p_t = 1;
    std::mt19937     generator(1);
    const ContactLaw law{mu, c, p_t, true};
    unsigned int     n_of[3] = {0, 0, 0};
    for (unsigned int i = 0; i < 2000; ++i)
      {
        Tensor<1, dim> n = any_vector<dim>(generator);
        n /= n.norm();
        const Tensor<1, dim> trial    = 5. * any_vector<dim>(generator);
        const bool           was_open = i % 2;
        const auto           of       = [&](const Tensor<1, dim> &t) {
          return law.response(t, n, was_open, 0.);
        };
        const ContactResponse<dim> found = of(trial);
        ++n_of[static_cast<unsigned int>(found.status)];
        const double tau_n = found.traction * n;
        const double shear = (found.traction - tau_n * n).norm();
        EXPECT_LE(tau_n, was_open ? 1e-12 : p_t);
        EXPECT_LE(shear,
                  std::max(0., (was_open ? 0. : c) - mu * tau_n) + 1e-12);
        // An admissible traction stays.
        EXPECT_LE((of(found.traction).traction - found.traction).norm(), 1e-12);
        for (unsigned int d = 0; d < dim; ++d)
          {
            constexpr double     step = 1e-6;
            const Tensor<1, dim> ahead =
              step * dealii::Point<dim>::unit_vector(d);
            const auto plus = of(trial + ahead), minus = of(trial - ahead);
            if (plus.status != minus.status)
              continue;
            const Tensor<1, dim> difference =
              (plus.traction - minus.traction) / (2 * step);
            EXPECT_LE((difference -
                       found.derivative * dealii::Point<dim>::unit_vector(d))
                        .norm(),
                      1e-7);
          }
      }
    for (const unsigned int n : n_of)
      EXPECT_GT(n, 100u);
  }



  TEST(ContactLaw, RandomTractions)
  {
    check_random_tractions<2>();
    check_random_tractions<3>();
  }



  TEST(ContactLaw, WithoutSeparationTensionHasNoLimit)
  {
    const ContactLaw law{0.3, 2., 0., false};
    Tensor<1, 2>     n, trial;
    n[0]             = 1;
    trial[0]         = 10;
    trial[1]         = 3;
    const auto found = law.response(trial, n, false, 0.);
    EXPECT_EQ(found.traction[0], 10);
    EXPECT_EQ(found.traction[1], 0); // tension leaves nothing of the adhesion
    // An open gap stays open until it closes.
    EXPECT_EQ(law.response(trial, n, true, 0.).status, ContactStatus::open);
  }



  TEST(ContactLaw, TractionsTurnWithTheNormal)
  {
    std::mt19937 generator(2);
    for (unsigned int i = 0; i < 100; ++i)
      {
        Tensor<1, 3> a = any_vector<3>(generator),
                     b = a + 0.3 * any_vector<3>(generator);
        a /= a.norm();
        b /= b.norm();
        const Tensor<1, 3> t    = any_vector<3>(generator);
        const Tensor<1, 3> turn = turned<3>(t, a, b);
        EXPECT_NEAR(turn.norm(), t.norm(), 1e-12);
        EXPECT_NEAR(turn * b, t * a, 1e-12);
        EXPECT_LE((turned<3>(turn, b, a) - t).norm(), 1e-12);
      }
  }
} // namespace
