// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/run/stage_start.h>
#include <moraine/run/step_driver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const std::string materials_text = R"(
subsection Method
  set Method = material point
end
subsection Materials
  subsection soil
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
)";



    /** Two cells filled with material that is pulled from the bottom. */
    const std::string scene_text = materials_text + R"(
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 2, 4
  set Cell size    = 1
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
        if (driver != nullptr)
          {
            accepted = Archive();
            driver->write(accepted);
          }
      }

      void
      newton_iteration(const NewtonIteration &,
                       const TimeControl &time) override
      {
        if (time.n_accepted() == interrupts_after)
          std::raise(SIGTERM);
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
      StepDriver<2>      *driver  = nullptr;
      /** It does so in the first iteration after that many steps. */
      unsigned int interrupts_after = numbers::invalid_unsigned_int;
      Archive      accepted; ///< what the driver wrote last
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
        , diagnostics(model.objects(scene))
        , driver(scene, model, diagnostics, {&listener})
      {
        begin_first_step(scene, model, diagnostics);
      }

      Archive
      archive() const
      {
        Archive result;
        driver.write(result);
        return result;
      }

      Scene<2>            scene;
      std::ostringstream  unused;
      dealii::TimerOutput timer;
      Model<2>            model;
      Listener            listener;
      Diagnostics<2>      diagnostics;
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



  /** Where a TrappedTerm throws. */
  enum class Place
  {
    begin_step,
    constrain,
    begin_trial,
    add,
    symmetric,
    augment,
    failure,
    prepare,
    report
  };

  /** A term without effect that throws once. */
  class TrappedTerm : public ConstraintTerm<2>
  {
  public:
    TrappedTerm(const Place place, const double t)
      : place(place)
      , t(t)
    {}

    std::vector<Effect>
    effects(const StepContext<2> &) const override
    {
      return {};
    }

    bool
    begin_step(const StepContext<2> &context) override
    {
      // The end of the step is not known yet.
      if (context.t_start >= t - 0.26)
        visit(Place::begin_step, t);
      return false;
    }

    void
    constrain(const StepContext<2> &context,
              AffineConstraints<double> &) const override
    {
      visit(Place::constrain, context.t_end);
    }

    void
    begin_trial(const StepContext<2> &context) override
    {
      visit(Place::begin_trial, context.t_end);
    }

    void
    add(const StepContext<2> &context,
        const bool,
        GlobalSystem<2> &) const override
    {
      visit(Place::add, context.t_end);
    }

    bool
    symmetric(const StepContext<2> &context) const override
    {
      visit(Place::symmetric, context.t_end);
      return true;
    }

    double
    violation(const StepContext<2> &) const override
    {
      return 0;
    }

    void
    augment(const StepContext<2> &context) override
    {
      visit(Place::augment, context.t_end);
    }

    std::string
    failure(const StepContext<2> &context,
            const std::vector<Tensor<1, 2>> &) const override
    {
      visit(Place::failure, context.t_end);
      return "";
    }

    void
    prepare(const StepContext<2> &context, const LA::Vector &) override
    {
      visit(Place::prepare, context.t_end);
    }

    void
    report(const StepContext<2> &context,
           std::vector<BoundaryReport<2>> &) const override
    {
      visit(Place::report, context.t_end);
    }

  private:
    void
    visit(const Place here, const double t_here) const
    {
      if (here != place || done || t_here < t)
        return;
      done = true;
      throw ComputationError("planted");
    }

    const Place  place;
    const double t;
    mutable bool done = false;
  };



  /** The names of data sets that differ by more than round-off: MUMPS does not
   * repeat itself bit by bit on several ranks. */
  std::string
  differences(const Archive &a, const Archive &b)
  {
    std::string names;
    for (const auto &[name, set] : a.data_sets())
      {
        const auto *x = std::get_if<std::vector<double>>(&set.values);
        if (name.find("/violation") != std::string::npos)
          continue; // is round-off itself
        if (x == nullptr)
          {
            if (b.data_sets().at(name).values != set.values)
              names += name + " ";
            continue;
          }
        const auto &y       = b.numbers(name, set.n_components);
        double      largest = x->size() == y.size() ? 0 : 1, size = 0;
        for (std::size_t i = 0; i < std::min(x->size(), y.size()); ++i)
          {
            largest = std::max(largest, std::abs((*x)[i] - y[i]));
            size    = std::max(size, std::abs(y[i]));
          }
        if (!(largest <= 1e-9 * size))
          names += name + " ";
      }
    return names;
  }



  /** Surfaces and loads carry something from step to step here. */
  const std::string carrying_scene_text = materials_text + R"(
subsection Mesh
  set Lower corner = 0, 0
  set Upper corner = 4, 4
  set Cell size    = 1
end
subsection Bodies
  subsection block
    set Shape        = box
    set Lower corner = 0.3, 0.3
    set Upper corner = 3.4, 3.3
  end
end
subsection Boundaries
  subsection left
    set Points      = 0.3, 4; 0.3, 0
    set Enforcement = augmented Lagrangian
  end
end
subsection Loads
  subsection end
    set Type  = surface traction
    set Body  = block
    set Part  = right
    set Value = 0; -20*t
  end
  subsection corner
    set Type     = force on points
    set Location = 3.4, 3.3
    set Value    = 10*t; 0
  end
end
subsection Probes
  subsection tip
    set Location = 3.3, 0.4
  end
end
subsection Time
  set Steps = 4
end
)";



  TEST(StepDriver, a_throw_anywhere_in_a_term_leaves_the_step_before)
  {
    const auto input = InputFile::from_text("scene.prm", carrying_scene_text);
    RunOfScene undisturbed(input);
    undisturbed.driver.run();
    for (const char *name : {"boundaries/left/carried/multiplier",
                             "loads/end/place",
                             "loads/corner/points",
                             "points/position"})
      EXPECT_TRUE(undisturbed.archive().contains(name)) << name;
    for (const Place place : {Place::begin_step,
                              Place::constrain,
                              Place::begin_trial,
                              Place::add,
                              Place::symmetric,
                              Place::augment,
                              Place::failure,
                              Place::prepare,
                              Place::report})
      {
        SCOPED_TRACE(static_cast<int>(place));
        RunOfScene run(input);
        run.listener.driver = &run.driver;
        run.model.system->add(std::make_unique<TrappedTerm>(place, 0.7));
        EXPECT_THROW(run.driver.run(), ComputationError);
        EXPECT_LT(run.listener.n_steps, 4u);
        run.driver.undo();
        EXPECT_TRUE(run.archive() == run.listener.accepted);

        run.driver.run();
        EXPECT_EQ(run.listener.n_steps, 4u);
        EXPECT_EQ(differences(run.archive(), undisturbed.archive()), "");
      }
  }



  /** A term without effect for which two steps fail at first: before their
   * first iteration or after their last one. */
  class FailingTerm : public ConstraintTerm<2>
  {
  public:
    explicit FailingTerm(const bool early)
      : early(early)
    {}

    std::vector<Effect>
    effects(const StepContext<2> &) const override
    {
      return {};
    }

    bool
    begin_step(const StepContext<2> &) override
    {
      return false;
    }

    void
    begin_trial(const StepContext<2> &) override
    {}

    void
    add(const StepContext<2> &context,
        const bool            tangent,
        GlobalSystem<2>      &system) const override
    {
      if (!early || !fails(context))
        return;
      LocalSystem<2>     local;
      const unsigned int node = 0;
      local.reinit(context.state, &node, 1, tangent);
      local.force[0] = std::numeric_limits<double>::quiet_NaN();
      system.add(local, tangent);
    }

    double
    violation(const StepContext<2> &) const override
    {
      return 0;
    }

    void
    augment(const StepContext<2> &) override
    {}

    std::string
    failure(const StepContext<2> &context,
            const std::vector<Tensor<1, 2>> &) const override
    {
      return !early && fails(context) ? "planted" : "";
    }

    void
    prepare(const StepContext<2> &, const LA::Vector &) override
    {}

    void
    report(const StepContext<2> &,
           std::vector<BoundaryReport<2>> &) const override
    {}

  private:
    /** In two steps of the first size. */
    static bool
    fails(const StepContext<2> &context)
    {
      return context.t_end - context.t_start > 0.05 &&
             (std::abs(context.t_start - 0.2) < 0.05 ||
              std::abs(context.t_start - 0.8) < 0.05);
    }

    const bool early;
  };



  /** A block on a surface that goes to and fro, so that it sticks and slides.
   */
  const std::string contact_scene_text = materials_text + R"(
subsection Mesh
  set Lower corner = -0.3, -0.3
  set Upper corner = 2.7, 2.7
  set Cell size    = 0.5
end
subsection Bodies
  subsection block
    set Shape        = box
    set Lower corner = 0, 0
    set Upper corner = 2, 2
  end
end
subsection Boundaries
  subsection floor
    set Points      = -1, 0; 4, 0
    set Constraint  = contact
    set Friction    = 0.3
    set Translation = 0.02*sin(2*pi*t); 0
  end
  subsection top
    set Points      = 2, 2; 0, 2
    set Translation = 0; -0.01*min(1, 8*t)
  end
end
subsection Probes
  subsection middle
    set Location = 1.1, 1.1
  end
end
subsection Time
  set Steps = 16
end
)";



  /** What a trial that failed after its passes leaves is what one leaves that
   * had none. */
  TEST(StepDriver, rejected_steps_leave_nothing_in_contact)
  {
    const auto input = InputFile::from_text("scene.prm", contact_scene_text);
    Archive    of_run[2];
    for (const bool early : {false, true})
      {
        RunOfScene run(input);
        run.model.system->add(std::make_unique<FailingTerm>(early));
        EXPECT_TRUE(run.driver.run());
        EXPECT_GT(run.driver.time().n_rejected(), 0u);
        of_run[early] = run.archive();
      }
    EXPECT_TRUE(of_run[0].contains("contact/floor/traction"));
    EXPECT_EQ(differences(of_run[0], of_run[1]), "");
  }



  TEST(StepDriver, a_signal_in_a_step_leaves_the_one_before)
  {
    const auto input = InputFile::from_text("scene.prm", carrying_scene_text);
    RunOfScene undisturbed(input);
    undisturbed.driver.run();

    RunOfScene run(input);
    run.listener.driver           = &run.driver;
    run.listener.interrupts_after = 2;
    {
      const InterruptHandler handler(false);
      EXPECT_FALSE(run.driver.run());
    }
    EXPECT_EQ(run.listener.n_steps, 2u);
    EXPECT_TRUE(run.archive() == run.listener.accepted);

    run.listener.interrupts_after = numbers::invalid_unsigned_int;
    const InterruptHandler handler(false);
    EXPECT_TRUE(run.driver.run());
    EXPECT_EQ(run.listener.n_steps, 4u);
    EXPECT_EQ(differences(run.archive(), undisturbed.archive()), "");
  }



  TEST(StepDriver, one_that_reads_what_another_wrote_goes_on_like_it)
  {
    const auto input = InputFile::from_text("scene.prm", carrying_scene_text);
    RunOfScene undisturbed(input);
    Archive    saved;
    undisturbed.driver.run([&]() {
      if (undisturbed.driver.time().n_accepted() != 2)
        return;
      undisturbed.driver.write(saved);
      undisturbed.driver.write_progress(saved);
      undisturbed.model.system->forget_couplings();
    });

    RunOfScene resumed(input);
    resumed.driver.read(
      saved.gathered(MPI_COMM_WORLD).scattered(MPI_COMM_WORLD));
    EXPECT_EQ(resumed.driver.time().n_accepted(), 2u);
    EXPECT_EQ(resumed.driver.reports()[0].name, "left");
    resumed.driver.run();
    EXPECT_EQ(resumed.listener.t_start.front(), 0.5);
    EXPECT_EQ(resumed.listener.u.size(), 2u);
    EXPECT_EQ(differences(resumed.archive(), undisturbed.archive()), "");
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      {
        EXPECT_TRUE(resumed.archive() == undisturbed.archive());
      }
    EXPECT_EQ(resumed.driver.counts().newton_iterations,
              undisturbed.driver.counts().newton_iterations);
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
              (std::vector<std::string>{"finite element",
                                        "material point",
                                        "GIMP",
                                        "CPDI1",
                                        "CPDI2",
                                        "DM",
                                        "DM-G",
                                        "DM-C",
                                        "DM-GC"}));
  }
} // namespace moraine
