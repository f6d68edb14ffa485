// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/run/resume.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace
{
  using namespace moraine;

  const std::string text = "set Dimension = 2\n"
                           "subsection Mesh\n"
                           "  set Lower corner = 0, 0\n"
                           "  set Upper corner = 1, 1\n"
                           "  set Cell size = 1\n"
                           "end\n"
                           "subsection Materials\n"
                           "  subsection soil\n"
                           "    set Young modulus = 1\n"
                           "    set Poisson ratio = 0\n"
                           "  end\n"
                           "end\n"
                           "subsection Bodies\n"
                           "  subsection block\n"
                           "    set Lower corner = 0, 0\n"
                           "    set Upper corner = 1, 1\n"
                           "  end\n"
                           "end\n";



  std::string
  parameters_of(Scene<2> &scene)
  {
    std::ostringstream all;
    scene.parameters().print_parameters(
      all,
      dealii::ParameterHandler::Text |
        dealii::ParameterHandler::KeepDeclarationOrder);
    return all.str();
  }



  std::string
  without(const std::string &key, const std::string &parameters)
  {
    std::istringstream lines(parameters);
    std::string        rest;
    for (std::string line; std::getline(lines, line);)
      if (line.find("set " + key + " ") == std::string::npos)
        rest += line + "\n";
    return rest;
  }



  /** A run goes on with a newer program, which has one more key. */
  TEST(Resume, takes_defaults_that_are_new)
  {
    InputFile input = InputFile::from_text("scene.prm", text);
    Scene<2>  scene(input);
    SavedRun  saved;
    saved.path             = "a.h5";
    saved.label.revision   = "1a2b3c";
    saved.label.parameters = without("Return tolerance", parameters_of(scene));
    saved.state.write("run/stage", 0u);
    EXPECT_EQ(
      check_changes(saved, scene, input, parameters_of(scene)),
      "the program that wrote the checkpoint, revision 1a2b3c, did not "
      "have keys that now have defaults: 'Method/Return tolerance = 0'");

    input.apply_override("Method/Return tolerance = 0.25");
    Scene<2> other(input);
    try
      {
        check_changes(saved, other, input, parameters_of(other));
        FAIL() << "A key that was not there is set.";
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(std::string(error.what())
                    .find(
                      "section 'Method', key 'Return tolerance': found '0.25', "
                      "allowed: nothing, as in the checkpoint"),
                  0u)
          << error.what();
      }
  }
} // namespace
