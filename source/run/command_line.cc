// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/command_line.h>

#include <moraine/core/console.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/interrupt.h>
#include <moraine/core/nearest.h>
#include <moraine/core/version.h>
#include <moraine/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    const char *const usage =
      "moraine run FILE.prm [--set \"Section/Key = value\"] [--output DIR] "
      "[--overwrite]\n"
      "moraine check FILE.prm       read, cross-check, say what will be "
      "simulated; compute nothing\n"
      "moraine study FILE.prm       every combination of the {{a|b|c}} entries\n"
      "moraine parameters           every parameter with default, allowed "
      "values and text\n"
      "moraine --version | --help\n";



    struct Arguments
    {
      std::string              command;
      std::string              file;
      std::vector<std::string> settings;
      RunOptions               options;
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
          else if (words[i].rfind("-", 0) == 0 && !arguments.command.empty())
            throw InputError(
              "unknown option '" + words[i] + "'" +
              suggest(words[i], {"--set", "--output", "--overwrite"}));
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



    unsigned int
    dimension_of(const InputFile &input)
    {
      const std::string text = input.get("", "Dimension", "2");
      if (text != "2" && text != "3")
        throw InputError(place("", "Dimension") + ": found '" + text +
                         "', allowed: 2, 3");
      return text == "3" ? 3 : 2;
    }



    template <int dim>
    int
    run_scene(const Arguments &arguments, const InputFile &input)
    {
      Console    console(MPI_COMM_WORLD);
      Scene<dim> scene(input);
      RunOptions options = arguments.options;
      if (options.output_directory.empty())
        options.output_directory = scene.output.directory;
      if (options.output_directory.empty())
        options.output_directory =
          "output/" + std::filesystem::path(arguments.file).stem().string();
      Simulation<dim> simulation(scene, MPI_COMM_WORLD, console);
      if (arguments.command == "check")
        {
          simulation.describe();
          console << "  nothing wrong was found" << std::endl;
          return done;
        }
      install_interrupt_handler(
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
      const Summary summary = simulation.run(options, input);
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
        {
          const InputFile input = read_input(arguments);
          return dimension_of(input) == 2 ? run_scene<2>(arguments, input) :
                                            run_scene<3>(arguments, input);
        }
      throw InputError(
        "unknown command '" + arguments.command + "'" +
        suggest(arguments.command, {"run", "check", "study", "parameters"}));
    }
  } // namespace



  int
  main_program(const std::vector<std::string> &arguments)
  {
    const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    const auto say  = [root](const std::string &what) {
      if (root)
        std::cerr << "moraine: " << what << std::endl;
    };
    try
      {
        return dispatch(arguments);
      }
    catch (const InputError &error)
      {
        say(error.what());
        return wrong_input;
      }
    catch (const ComputationError &error)
      {
        say(error.what());
        return not_converged;
      }
    catch (const std::exception &error)
      {
        say(std::string("internal error, please report it: ") + error.what());
        return internal_error;
      }
  }
} // namespace moraine
