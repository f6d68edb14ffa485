// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/stage_start.h>
#include <moraine/run/step_driver.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string free_block_text = R"(
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 5, 5
  set Cell size    = 0.25
end
subsection Method
  set Method = METHOD
end
subsection Materials
  subsection rubber
    set Young modulus = 1e4
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Bodies
  subsection block
    set Shape            = box
    set Lower corner     = 0, 0
    set Upper corner     = 2, 2
    set Translation      = SHIFT
    set Initial velocity = 0.2*(x - CENTRE_X); -0.1*(y - CENTRE_Y)
  end
end
subsection Time
  set Integrator = Newmark
  set End time   = 0.04
  set Steps      = 8
end
subsection Solver
  set Solver = amg-cg
end
)";



    std::string
    with(std::string text, const std::string &word, const std::string &value)
    {
      return text.replace(text.find(word), word.size(), value);
    }



    /** The block that vibrates at @p place in the mesh. */
    InputFile
    block_at(const std::string &method, const Point<2> &place)
    {
      std::string text = with(free_block_text, "METHOD", method);
      text             = with(text,
                  "SHIFT",
                  std::to_string(place[0]) + ", " + std::to_string(place[1]));
      text             = with(text, "CENTRE_X", std::to_string(place[0] + 1));
      text             = with(text, "CENTRE_Y", std::to_string(place[1] + 1));
      return InputFile::from_text("scene.prm", text);
    }



    class Fastest : public RunObserver<2>
    {
    public:
      explicit Fastest(const Model<2> &model)
        : model(model)
      {}

      void
      step_accepted(const AcceptedStep<2> &) override
      {
        for (const auto &v : model.motion->velocities())
          of_nodes = std::max(of_nodes, v.norm());
        const auto field = model.points->fields().find(FieldNames<2>::velocity);
        for (unsigned int p = 0; p < model.points->n_local(); ++p)
          of_points =
            std::max(of_points, field(model.points->values(p)).norm());
      }

      const Model<2> &model;
      double          of_nodes = 0, of_points = 0;
    };



    struct Effort
    {
      double of_nodes   = 0; ///< the largest velocity of a node
      double of_points  = 0;
      double iterations = 0; ///< of the linear solver, a step
    };



    Effort
    run(const InputFile &input)
    {
      std::ostringstream unused;
      TimerOutput    timer(unused, TimerOutput::never, TimerOutput::wall_times);
      const Scene<2> scene(input);
      Model<2>       model(scene, MPI_COMM_WORLD, timer);
      Fastest        fastest(model);
      Diagnostics<2> diagnostics(model.objects(scene));
      StepDriver<2>  driver(scene, model, diagnostics, {&fastest});
      begin_first_step(scene, model, diagnostics);
      EXPECT_TRUE(driver.run());
      EXPECT_EQ(driver.time().n_rejected(), 0u);
      EXPECT_EQ(driver.counts().n_fictitious_stiffness, 0u);
      return {Utilities::MPI::max(fastest.of_nodes, MPI_COMM_WORLD),
              Utilities::MPI::max(fastest.of_points, MPI_COMM_WORLD),
              driver.counts().linear_iterations / 8.};
    }



    constexpr unsigned int n_places = 10;



    /** The most of many random places, and of one on the lines of the mesh. */
    Effort
    most_of(const std::string &method)
    {
      Effort       worst = run(block_at(method, Point<2>(1.5, 1.5)));
      std::mt19937 random(1);
      const auto   draw = [&random]() {
        return 1.5 + 0.25 * random() / double(std::mt19937::max());
      };
      for (unsigned int i = 0; i < n_places; ++i)
        {
          const double x   = draw();
          const Effort one = run(block_at(method, Point<2>(x, draw())));
          worst.of_nodes   = std::max(worst.of_nodes, one.of_nodes);
          worst.of_points  = std::max(worst.of_points, one.of_points);
          worst.iterations = std::max(worst.iterations, one.iterations);
        }
      std::cout << method << ": largest velocity of nodes " << worst.of_nodes
                << ", of points " << worst.of_points << ", linear iterations "
                << worst.iterations << std::endl;
      return worst;
    }
  } // namespace



  TEST(FreeBlock, tiny_masses_of_nodes_do_not_show)
  {
    // Elements on the lines of the mesh.
    const Effort known = run(block_at("finite element", Point<2>(1.5, 1.5)));
    std::cout << "on the lines: velocity of nodes " << known.of_nodes
              << ", of points " << known.of_points << ", linear iterations "
              << known.iterations << std::endl;
    for (const char *method :
         {"finite element", "material point", "GIMP", "CPDI1"})
      {
        const Effort most = most_of(method);
        EXPECT_LT(most.of_points, 1.05 * known.of_points) << method;
        EXPECT_LT(most.iterations, known.iterations + 4) << method;
        // Where functions end with a gradient of 0, as those of GIMP and CPDI
        // do, forces end slower than masses.
        const bool ends_abruptly = std::string(method) == "finite element" ||
                                   std::string(method) == "material point";
        EXPECT_LT(most.of_nodes, (ends_abruptly ? 6 : 1e5) * known.of_nodes)
          << method;
      }
  }
} // namespace moraine
