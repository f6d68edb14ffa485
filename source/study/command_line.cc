// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/study/command_line.h>

#include <moraine/core/console.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/exit.h>
#include <moraine/core/interrupt.h>
#include <moraine/core/memory.h>
#include <moraine/core/version.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/catalogue.h>
#include <moraine/scene/located.h>
#include <moraine/scene/parameter_reference.h>
#include <moraine/run/resume.h>
#include <moraine/study/buckling_study.h>
#include <moraine/study/material_test_command.h>
#include <moraine/study/safety_study.h>
#include <moraine/scene/scene.h>
#include <moraine/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <functional>
#include <iostream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    struct Command
    {
      std::string              name;
      std::string              argument;
      std::string              text;
      std::vector<std::string> options;
    };

    const std::vector<Command> &
    commands()
    {
      static const std::vector<Command> all{
        {"run",
         "FILE.prm",
         "simulate a scene",
         {"--set", "--output", "--overwrite", "--quiet", "--verbose"}},
        {"resume",
         "OUTPUT",
         "go on with a run from its last checkpoint",
         {"--from", "--set", "--quiet", "--verbose"}},
        {"check",
         "FILE.prm",
         "read, cross-check, say what will be simulated; compute nothing",
         {"--set"}},
        {"study",
         "FILE.prm",
         "every combination of {{a|b|c}} entries; factor of safety; buckling",
         {"--set", "--output", "--overwrite"}},
        {"test-material",
         "FILE.prm",
         "triaxial, oedometer, shear and other tests of a material at one point",
         {"--material", "--set", "--output"}},
        {"parameters",
         "",
         "every parameter with default, allowed values and text",
         {}},
        {"explain",
         "[ID]",
         "cause, size and cure of a diagnostic; all of them without ID",
         {}},
        {"plot",
         "OUTPUT",
         "pictures of a finished run: fields, and curves of its history",
         {}}};
      return all;
    }



    struct Option
    {
      std::string name;
      std::string value;
      std::string text;
    };

    const std::vector<Option> &
    options()
    {
      static const std::vector<Option> all{
        {"--set",
         "\"Section/Key = value\"",
         "change the scene; may be repeated"},
        {"--material", "NAME", "of a scene with more than one"},
        {"--from",
         "N|T",
         "the checkpoint after step N, or at time T as in 0.5"},
        {"--output", "DIR", "folder for the results"},
        {"--overwrite", "", "replace the results of an earlier run in it"},
        {"--quiet", "", "show only how the run ends, its warnings, and errors"},
        {"--verbose", "", "show timings, hints and every Newton iteration"}};
      return all;
    }



    std::string
    padded(const std::string &text, const unsigned int width)
    {
      return text.size() + 2 > width ?
               text + "\n" + std::string(width + 2, ' ') :
               text + std::string(width - text.size(), ' ');
    }



    /** What `moraine --help` shows. */
    std::string
    usage()
    {
      std::string text = "moraine COMMAND ...\n";
      for (const Command &command : commands())
        text += "  " + padded(command.name + " " + command.argument, 22) +
                command.text + '\n';
      return text +
             "  COMMAND --help        the options of a command\n"
             "  --version, --help\n"
             "With the script of the source folder also\n"
             "  ./moraine --ranks N COMMAND ...   the same on N processes (else "
             "mpirun -n N moraine COMMAND ...)\n"
             "  ./moraine test                    build and run the tests\n";
    }



    /** What `moraine COMMAND --help` shows. */
    std::string
    usage_of(const Command &command)
    {
      std::string text = "moraine " + command.name + ' ' + command.argument +
                         " [OPTIONS]\n" + command.text + '\n';
      for (const Option &option : options())
        if (contains(command.options, option.name))
          text += "  " + padded(option.name + ' ' + option.value, 30) +
                  option.text + '\n';
      return text;
    }



    struct Arguments
    {
      std::string              command;
      std::string              file;
      std::vector<std::string> settings;
      std::string              from;
      std::string              material;
      RunOptions               options;
      bool                     help = false;
    };



    const Command &
    find_command(const std::string &name)
    {
      std::vector<std::string> names;
      for (const Command &command : commands())
        {
          if (command.name == name)
            return command;
          names.push_back(command.name);
        }
      throw InputError("unknown command '" + name + "'" + suggest(name, names));
    }



    /** @throw InputError unless the command has this option. */
    void
    check_option(const std::string &option, const std::string &command)
    {
      const std::vector<std::string> &known = find_command(command).options;
      if (!contains(known, option))
        throw InputError("unknown option '" + option + "' of 'moraine " +
                         command + "'" + suggest(option, known));
    }



    void
    read_option(const std::string                  &option,
                const std::function<std::string()> &value,
                Arguments                          &arguments)
    {
      check_option(option, arguments.command);
      if (option == "--set")
        arguments.settings.push_back(value());
      else if (option == "--from")
        arguments.from = value();
      else if (option == "--material")
        arguments.material = value();
      else if (option == "--output")
        arguments.options.output_directory = value();
      else if (option == "--overwrite")
        arguments.options.overwrite = true;
      else if (option == "--quiet")
        arguments.options.verbosity = Verbosity::quiet;
      else
        arguments.options.verbosity = Verbosity::verbose;
    }



    Arguments
    read_arguments(const std::vector<std::string> &words)
    {
      Arguments arguments;
      for (unsigned int i = 0; i < words.size(); ++i)
        {
          const std::string &word  = words[i];
          const auto         value = [&]() {
            if (i + 1 == words.size())
              throw InputError("option '" + word + "' needs a value\n" +
                               usage_of(find_command(arguments.command)));
            return words[++i];
          };
          if (arguments.command.empty())
            arguments.command = word;
          else if (word == "--help")
            arguments.help = true;
          else if (word.rfind("-", 0) == 0)
            read_option(word, value, arguments);
          else if (arguments.file.empty())
            arguments.file = word;
          else
            throw InputError("superfluous argument '" + word + "'\n" + usage());
        }
      return arguments;
    }



    InputFile
    read_input(const Arguments &arguments)
    {
      if (arguments.file.empty())
        throw InputError("'moraine " + arguments.command +
                         "' needs the name of a .prm file\n" +
                         usage_of(find_command(arguments.command)));
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
          throw InputError(located(input, error));
        }
    }



    /** @return the exit code. */
    template <int dim>
    int
    run_with(const InputFile &input, const RunOptions &options)
    {
      Console console(MPI_COMM_WORLD);
      console.set_quiet(options.verbosity == Verbosity::quiet);
      const InterruptHandler handler(
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
      const Summary summary =
        simulate<dim>(input, options, MPI_COMM_WORLD, console);
      return summary.status == "ok" ? done : not_converged;
    }



    int
    resume(const Arguments &arguments)
    {
      if (arguments.file.empty())
        throw InputError("'moraine resume' needs the folder of a run\n" +
                         usage_of(find_command(arguments.command)));
      SavedRun saved =
        read_checkpoint(arguments.file, arguments.from, MPI_COMM_WORLD);
      InputFile input =
        InputFile::from_text(saved.path, saved.label.parameters);
      for (const std::string &setting : arguments.settings)
        input.apply_override(setting);
      RunOptions options       = arguments.options;
      options.output_directory = arguments.file;
      options.saved            = &saved;
      try
        {
          return saved.label.dimension == 2 ? run_with<2>(input, options) :
                                              run_with<3>(input, options);
        }
      catch (const InputError &error)
        {
          throw InputError(located(input, error));
        }
    }



    int
    study(const Arguments &arguments, const InputFile &input)
    {
      Console            console(MPI_COMM_WORLD);
      const StudySetting setting{
        input,
        output_directory(arguments, input.get("Output", "Directory", "")),
        arguments.options.overwrite,
        MPI_COMM_WORLD,
        console};
      const InterruptHandler handler(
        Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
      const std::string kind =
        input.get("Study", "Kind", StudyParameters().kind);
      return kind == "factor of safety" ? find_factor_of_safety(setting) :
             kind == "buckling"         ? find_buckling_loads(setting) :
                                          run_study(setting);
    }



    template <int dim>
    int
    run_scene(const Arguments &arguments, const InputFile &input)
    {
      if (arguments.command == "check")
        {
          Console console(MPI_COMM_WORLD);
          if (!describe<dim>(input, MPI_COMM_WORLD, console))
            console << "  nothing wrong was found\n";
          console << "" << std::flush;
          return done;
        }
      RunOptions options = arguments.options;
      options.output_directory =
        output_directory(arguments, input.get("Output", "Directory", ""));
      return run_with<dim>(input, options);
    }



    /** @return whether only a text was asked for, which is shown then. */
    bool
    show_text(const Arguments &arguments)
    {
      std::string text;
      if (arguments.command == "--version")
        text = "moraine " + std::string(version) + '\n';
      else if (arguments.command.empty() || arguments.command == "--help")
        text = usage();
      else if (arguments.help)
        text = usage_of(find_command(arguments.command));
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << text << std::flush;
      return !text.empty();
    }



    int
    dispatch(const std::vector<std::string> &words)
    {
      const Arguments arguments = read_arguments(words);
      if (show_text(arguments))
        return arguments.command.empty() ? wrong_input : done;
      find_command(arguments.command);
      if (arguments.command == "run" || arguments.command == "check")
        return with_input(arguments, [&](const InputFile &input) {
          return dimension_of(input) == 2 ? run_scene<2>(arguments, input) :
                                            run_scene<3>(arguments, input);
        });
      if (arguments.command == "explain")
        {
          if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
            {
              if (arguments.file.empty())
                print_catalogue(std::cout);
              else
                std::cout << explanation(arguments.file);
            }
          return done;
        }
      if (arguments.command == "resume")
        return resume(arguments);
      if (arguments.command == "study")
        return with_input(arguments, [&](const InputFile &input) {
          return study(arguments, input);
        });
      if (arguments.command == "test-material")
        return with_input(arguments, [&](const InputFile &input) {
          return test_material(
            input,
            arguments.material,
            output_directory(arguments, input.get("Output", "Directory", "")),
            MPI_COMM_WORLD);
        });
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        print_parameter_reference(std::cout);
      return done;
    }
  } // namespace



  int
  main_program(const std::vector<std::string> &arguments)
  {
    const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    prepare_exit();
    const auto fail = [root](const ExitCode code, const std::string &what) {
      end_if_alone(code, what);
      if (root)
        std::cerr << "moraine: " << what << std::endl;
      return code;
    };
    try
      {
        return with_memory([&]() { return dispatch(arguments); });
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
