// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/command_line.h>

#include <moraine/core/console.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/core/nearest.h>
#include <moraine/core/version.h>
#include <moraine/run/parameter_reference.h>
#include <moraine/run/simulation.h>
#include <moraine/run/study.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** For failures alone, so that nothing else can meet its barrier. */
    MPI_Comm failure_communicator = MPI_COMM_NULL;



    /**
     * Whether every rank comes here within some seconds. A rank that failed
     * alone must not wait for the others, which wait for it elsewhere.
     */
    bool
    all_ranks_fail()
    {
      MPI_Request request;
      MPI_Ibarrier(failure_communicator, &request);
      int arrived = 0;
      for (unsigned int i = 0; i < 300 && arrived == 0; ++i)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          if (arrived == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      return arrived != 0;
    }



    const char *const usage =
      "moraine run FILE.prm [--set \"Section/Key = value\"] [--output DIR] "
      "[--overwrite]\n"
      "moraine check FILE.prm       read, cross-check, say what will be "
      "simulated; compute nothing\n"
      "moraine study FILE.prm [--set ...] [--output DIR] [--overwrite]\n"
      "                             every combination of the {{a|b|c}} entries: "
      "error against time\n"
      "moraine parameters [--dimension 2|3]\n"
      "                             every parameter with default, allowed "
      "values and text\n"
      "moraine --version | --help\n";



    struct Arguments
    {
      std::string              command;
      std::string              file;
      std::vector<std::string> settings;
      RunOptions               options;
      unsigned int             dimension = 2;
    };



    Arguments
    read_arguments(const std::vector<std::string> &words)
    {
      Arguments arguments;
      for (unsigned int i = 0; i < words.size(); ++i)
        {
          const auto value = [&]() {
            if (i + 1 == words.size())
              throw InputError("option '" + words[i] + "' needs a value\n" +
                               usage);
            return words[++i];
          };
          if (words[i] == "--set")
            arguments.settings.push_back(value());
          else if (words[i] == "--output")
            arguments.options.output_directory = value();
          else if (words[i] == "--overwrite")
            arguments.options.overwrite = true;
          else if (words[i] == "--dimension")
            {
              const std::string text = value();
              if (text != "2" && text != "3")
                throw InputError("option '--dimension': found '" + text +
                                 "', allowed: 2, 3");
              arguments.dimension = text == "3" ? 3 : 2;
            }
          else if (words[i].rfind("-", 0) == 0 && !arguments.command.empty())
            throw InputError(
              "unknown option '" + words[i] + "'" +
              suggest(words[i],
                      {"--set", "--output", "--overwrite", "--dimension"}));
          else if (arguments.command.empty())
            arguments.command = words[i];
          else if (arguments.file.empty())
            arguments.file = words[i];
          else
            throw InputError("superfluous argument '" + words[i] + "'\n" +
                             usage);
        }
      return arguments;
    }



    InputFile
    read_input(const Arguments &arguments)
    {
      if (arguments.file.empty())
        throw InputError("'moraine " + arguments.command +
                         "' needs the name of a .prm file\n" + usage);
      InputFile input = InputFile::read(arguments.file);
      for (const std::string &setting : arguments.settings)
        input.apply_override(setting);
      return input;
    }



    std::string
    output_directory(const Arguments &arguments, const std::string &of_scene)
    {
      if (!arguments.options.output_directory.empty())
        return arguments.options.output_directory;
      if (!of_scene.empty())
        return of_scene;
      return "output/" + std::filesystem::path(arguments.file).stem().string();
    }



    /** Run @p command with the input file, to which its mistakes belong. */
    template <class Command>
    int
    with_input(const Arguments &arguments, const Command &command)
    {
      const InputFile input = read_input(arguments);
      try
        {
          return command(input);
        }
      catch (const InputError &error)
        {
          throw InputError(input.located(error.what()));
        }
    }



    int
    run_study(const Arguments &arguments, const InputFile &input)
    {
      Console console(MPI_COMM_WORLD);
      Study   study(input,
                  output_directory(arguments,
                                   input.get("Output", "Directory", "")),
                  arguments.options.overwrite,
                  MPI_COMM_WORLD,
                  console);
      install_interrupt_handler(
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
      return study.run();
    }



    template <int dim>
    int
    run_scene(const Arguments &arguments, const InputFile &input)
    {
      Console    console(MPI_COMM_WORLD);
      Scene<dim> scene(input);
      RunOptions options = arguments.options;
      options.output_directory =
        output_directory(arguments, scene.output.directory);
      if (arguments.command == "check")
        {
          describe(scene, MPI_COMM_WORLD, console);
          console << "  nothing wrong was found" << std::endl;
          return done;
        }
      install_interrupt_handler(
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
      const Summary summary =
        simulate(scene, input, options, MPI_COMM_WORLD, console);
      return summary.status == "ok" ? done : not_converged;
    }



    int
    dispatch(const std::vector<std::string> &words)
    {
      const Arguments arguments = read_arguments(words);
      const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      if (arguments.command == "--version")
        {
          if (root)
            std::cout << "moraine " << version << std::endl;
          return done;
        }
      if (arguments.command.empty() || arguments.command == "--help")
        {
          if (root)
            std::cout << usage << std::flush;
          return arguments.command.empty() ? wrong_input : done;
        }
      if (arguments.command == "run" || arguments.command == "check")
        return with_input(arguments, [&](const InputFile &input) {
          return dimension_of(input) == 2 ? run_scene<2>(arguments, input) :
                                            run_scene<3>(arguments, input);
        });
      if (arguments.command == "study")
        return with_input(arguments, [&](const InputFile &input) {
          return run_study(arguments, input);
        });
      if (arguments.command == "parameters")
        {
          if (root)
            print_parameter_reference(arguments.dimension, std::cout);
          return done;
        }
      throw InputError(
        "unknown command '" + arguments.command + "'" +
        suggest(arguments.command, {"run", "check", "study", "parameters"}));
    }
  } // namespace



  void
  end_if_alone(const ExitCode code, const std::string &what)
  {
    if (failure_communicator == MPI_COMM_NULL || all_ranks_fail())
      return;
    std::cerr << "moraine: " << what << std::endl;
    MPI_Abort(MPI_COMM_WORLD, code);
  }



  int
  main_program(const std::vector<std::string> &arguments)
  {
    const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    if (failure_communicator == MPI_COMM_NULL)
      failure_communicator =
        Utilities::MPI::duplicate_communicator(MPI_COMM_WORLD);
    const auto fail = [root](const ExitCode code, const std::string &what) {
      end_if_alone(code, what);
      if (root)
        std::cerr << "moraine: " << what << std::endl;
      return code;
    };
    try
      {
        return dispatch(arguments);
      }
    catch (const InputError &error)
      {
        return fail(wrong_input, error.what());
      }
    catch (const ComputationError &error)
      {
        return fail(not_converged, error.what());
      }
    catch (const std::exception &error)
      {
        return fail(internal_error,
                    std::string("internal error, please report it: ") +
                      error.what());
      }
  }
} // namespace moraine
