// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/run/step_driver.h>

#include <gtest/gtest.h>

namespace moraine
{
  namespace
  {
    /** Two cells filled with material that is pulled from the bottom. */
    const std::string scene_text = R"(
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 2, 4
  set Cell size    = 1
end
subsection Materials
  subsection soil
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Shape        = box
    set Lower corner = 0, 2
    set Upper corner = 2, 4
  end
end
subsection Grid conditions
  subsection top
    set Side = top
  end
end
subsection Loads
  subsection weight
    set Type  = body force
    set Value = 0; -FORCE*t
  end
end
subsection Probes
  subsection foot
    set Location = 1, 2.1
  end
end
subsection Time
  set Steps         = 4
  set Smallest step = 0.3
end
)";



    InputFile
    scene_with_force(const std::string &force)
    {
      std::string text = scene_text;
      text.replace(text.find("FORCE"), 5, force);
      return InputFile::from_text("scene.prm", text);
    }



    /** Writes down what it is told. */
    class Listener : public RunObserver<2>
    {
    public:
      explicit Listener(const Model<2> &model)
        : model(model)
      {}

      void
      run_begins() override
      {
        events += "begin ";
      }

      void
      step_accepted(const AcceptedStep<2> &step) override
      {
        events += "accept ";
        t_start.push_back(step.t_start);
        u.push_back(model.probes->values(*model.points)[1].value);
        n_steps = step.time.n_accepted();
      }

      void
      step_rejected(const double, const std::string &) override
      {
        events += "reject ";
      }

      const Model<2>     &model;
      std::string         events;
      std::vector<double> t_start;
      std::vector<double> u;
      unsigned int        n_steps = 0;
    };



    struct RunOfScene
    {
      explicit RunOfScene(const InputFile &input)
        : scene(input)
        , timer(unused,
                dealii::TimerOutput::never,
                dealii::TimerOutput::wall_times)
        , model(scene, MPI_COMM_WORLD, timer)
        , listener(model)
        , driver(scene, model, {&listener})
      {
        begin_first_step(scene, model);
      }

      Scene<2>            scene;
      std::ostringstream  unused;
      dealii::TimerOutput timer;
      Model<2>            model;
      Listener            listener;
      StepDriver<2>       driver;
    };
  } // namespace



  TEST(StepDriver, tells_observers_after_each_step)
  {
    RunOfScene run(scene_with_force("1"));
    EXPECT_TRUE(run.driver.run());
    EXPECT_EQ(run.listener.events, "begin accept accept accept accept ");
    EXPECT_EQ(run.listener.t_start, (std::vector<double>{0, 0.25, 0.5, 0.75}));
    EXPECT_EQ(run.driver.counts().newton_iterations, 4u);
    EXPECT_EQ(run.driver.reports().size(), 1u);
    EXPECT_NEAR(run.driver.reports()[0].reaction[1], 4., 1e-9);
    for (unsigned int i = 1; i < 4; ++i)
      EXPECT_LT(run.listener.u[i], run.listener.u[i - 1]);
  }



  /** A step that cannot be accepted counts for nobody. */
  TEST(StepDriver, a_step_that_fails_leaves_the_one_before)
  {
    RunOfScene run(scene_with_force("3000"));
    EXPECT_THROW(run.driver.run(), ComputationError);
    EXPECT_EQ(run.driver.time().n_accepted(), run.listener.n_steps);
    EXPECT_EQ(run.driver.time().n_accepted(), run.listener.u.size());
    ASSERT_FALSE(run.listener.u.empty());
    EXPECT_EQ(run.model.probes->values(*run.model.points)[1].value,
              run.listener.u.back());
  }



  TEST(Methods, one_list_of_different_names)
  {
    std::vector<std::string> names;
    for (const auto &method : methods<2>())
      {
        MethodParameters<2> parameters;
        parameters.method = method.name;
        EXPECT_EQ(&parameters.chosen(), &method);
        EXPECT_NO_THROW(parameters.check());
        EXPECT_EQ(parameters.after_step(), method.mesh_after_step);
        parameters.split_domains = "true";
        if (method.can_split_domains)
          EXPECT_NO_THROW(parameters.check());
        else
          EXPECT_THROW(parameters.check(), InputError);
        names.push_back(method.name);
      }
    EXPECT_EQ(names,
              (std::vector<std::string>{
                "finite element", "material point", "GIMP", "CPDI1", "CPDI2"}));
  }
} // namespace moraine
