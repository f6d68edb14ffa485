// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/core/input_file.h>
#include <moraine/core/input_text.h>
#include <moraine/core/patterns.h>

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include "message.h"

using moraine::InputError;
using moraine::InputFile;

namespace
{
  struct Scene
  {
    std::string      method = "GIMP";
    double           size   = 1;
    double           young = 1, poisson = 0;
    unsigned         n = 2;
    dealii::Point<2> corner;

    void
    declare(dealii::ParameterHandler &prm, const InputFile &file)
    {
      namespace p = moraine::patterns;
      prm.add_parameter("Method", method, "", p::selection({"GIMP", "MPM"}));
      prm.enter_subsection("Mesh");
      prm.add_parameter("Cell size", size, "", p::positive());
      prm.add_parameter("Lower corner", corner, "", p::numbers(2, 2));
      prm.add_parameter("Count", n, "", p::positive_integer());
      prm.leave_subsection();
      prm.enter_subsection("Materials");
      for (const std::string &name : file.names_in("Materials"))
        {
          prm.enter_subsection(name);
          prm.add_parameter("Young modulus", young, "", p::positive());
          prm.add_parameter("Poisson ratio",
                            poisson,
                            "",
                            dealii::Patterns::Double(0, 0.49));
          prm.leave_subsection();
        }
      prm.leave_subsection();
    }
  };

  Scene
  parse(const InputFile &file)
  {
    Scene                    scene;
    dealii::ParameterHandler prm;
    scene.declare(prm, file);
    file.parse(prm);
    return scene;
  }

  std::string
  input_mistake(const std::string &text)
  {
    return message_of<InputError>(
      [&] { parse(InputFile::from_text("f.prm", text)); });
  }

  const std::string good = "# a scene\n"
                           "set Method = MPM # comment\n"
                           "subsection Mesh\n"
                           "\tset Cell size = \\\n"
                           "    0.25\n"
                           "  set Lower corner = 1, -2\n"
                           "end\n"
                           "subsection Materials\n"
                           "  subsection wet clay\n"
                           "    set Young modulus = 5e3\n"
                           "  end\n"
                           "  subsection sand\n"
                           "  end\n"
                           "end\n";
} // namespace

TEST(InputFile, SkipsAByteOrderMark)
{
  const std::string text = "\xef\xbb\xbf" + good;
  EXPECT_EQ(parse(InputFile::from_text("f.prm", text)).method, "MPM");
}

TEST(InputFile, ReadsAGoodFile)
{
  const InputFile file  = InputFile::from_text("f.prm", good);
  const Scene     scene = parse(file);
  EXPECT_EQ(scene.method, "MPM");
  EXPECT_EQ(scene.size, 0.25);
  EXPECT_EQ(scene.corner, dealii::Point<2>(1, -2));
  EXPECT_EQ(scene.young, 5e3);
  EXPECT_EQ(file.names_in("Materials"),
            (std::vector<std::string>{"wet clay", "sand"}));
  EXPECT_EQ(file.names_in(""), (std::vector<std::string>{"Mesh", "Materials"}));
  EXPECT_TRUE(file.names_in("Bodies").empty());
  EXPECT_TRUE(file.has("Mesh", "Cell size"));
  EXPECT_EQ(file.entries()[1].origin, "f.prm:4");
  // The text is a complete input file again.
  EXPECT_EQ(parse(InputFile::from_text("g", file.text())).size, 0.25);
}

TEST(InputFile, Overrides)
{
  InputFile file = InputFile::from_text("f.prm", good);
  file.apply_override("Mesh/Cell size = 4");
  file.apply_override("Mesh/Cell size = 8");
  file.apply_override("Materials/wet clay/Poisson ratio = 0.3");
  file.apply_override("Method=GIMP");
  for (const InputFile &f : {file, InputFile::from_text("g", file.text())})
    {
      const Scene scene = parse(f);
      EXPECT_EQ(scene.size, 8);
      EXPECT_EQ(scene.poisson, 0.3);
      EXPECT_EQ(scene.method, "GIMP");
    }

  file.apply_override("Mesh/Cel size = 4");
  EXPECT_EQ(
    message_of<InputError>([&] { parse(file); }),
    "--set 'Mesh/Cel size = 4': section 'Mesh', key 'Cel size': unknown "
    "key; did you mean 'Cell size'? Allowed here: Cell size, Lower "
    "corner, Count");
  for (const char *bad : {"Mesh/Cell size", "= 3", "Mesh/ = 3", "/a/Cell = 3"})
    EXPECT_THROW(file.apply_override(bad), InputError) << bad;
}

TEST(InputFile, LocatesMessages)
{
  InputFile file = InputFile::from_text("f.prm", good);
  EXPECT_EQ(file.located("section 'Mesh', key 'Cell size': is odd"),
            "f.prm:4: section 'Mesh', key 'Cell size': is odd");
  EXPECT_EQ(file.located("section 'Mesh', key 'Colour': is not there"),
            "f.prm:3: section 'Mesh', key 'Colour': is not there");
  EXPECT_EQ(file.located("section 'Loads': nothing"),
            "f.prm: section 'Loads': nothing");
  EXPECT_EQ(file.located("the disk is full"), "the disk is full");
  file.apply_override("Mesh/Cell size = 7");
  EXPECT_EQ(file.located("section 'Mesh', key 'Cell size': is odd"),
            "--set 'Mesh/Cell size = 7': section 'Mesh', key 'Cell size': is "
            "odd");
}

TEST(InputFile, WithValueKeepsTheLine)
{
  const InputFile file = InputFile::from_text("f.prm", good).with_value(1, "x");
  EXPECT_EQ(message_of<InputError>([&] { parse(file); }),
            "f.prm:4: section 'Mesh', key 'Cell size': found 'x', allowed: a "
            "number > 0");
}

TEST(InputFile, Values)
{
  const auto size = [](const std::string &value) {
    return input_mistake("subsection Mesh\n set Cell size = " + value +
                         "\nend\n");
  };
  for (const char *bad :
       {"abc", "nan", "inf", "0", "-1", "1e999", "5 mm", "1,5"})
    EXPECT_EQ(size(bad),
              std::string("f.prm:2: section 'Mesh', key 'Cell size': found '") +
                bad + "', allowed: a number > 0");
  EXPECT_EQ(size("1e-400"),
            "f.prm:2: section 'Mesh', key 'Cell size': found '1e-400', which "
            "is 0, allowed: a number > 0");
  EXPECT_EQ(size(""),
            "f.prm:2: section 'Mesh', key 'Cell size': found nothing, allowed: "
            "a number > 0");
  EXPECT_EQ(input_mistake("set Method = FEM"),
            "f.prm:1: key 'Method': found 'FEM', allowed: one of GIMP, MPM");
  EXPECT_EQ(
    input_mistake("subsection Mesh\nset Count = -2\nend"),
    "f.prm:2: section 'Mesh', key 'Count': found '-2', allowed: a whole "
    "number >= 1");
  EXPECT_EQ(input_mistake("subsection Mesh\nset Lower corner = 1, 2, 3\nend"),
            "f.prm:2: section 'Mesh', key 'Lower corner': found '1, 2, 3', "
            "allowed: 2 numbers, separated by commas");
}

TEST(InputFile, Structure)
{
  EXPECT_EQ(input_mistake("subsection Mesh\nend\nend\n"),
            "f.prm:3: 'end' without a 'subsection' it could close");
  EXPECT_EQ(input_mistake("subsection Mesh\nCell size = 1\nend\n"),
            "f.prm:2: section 'Mesh', found 'Cell size = 1', allowed: "
            "subsection NAME, set KEY = VALUE, end, # comment");
  EXPECT_EQ(input_mistake("set Method\n"),
            "f.prm:1: found 'set Method', allowed: set KEY = VALUE");
  EXPECT_EQ(
    input_mistake("subsection a/b\nend\n"),
    "f.prm:1: found 'subsection a/b'; a subsection needs a name without '/'");
  EXPECT_EQ(input_mistake("include other.prm\n"),
            "f.prm:1: found 'include other.prm', allowed: subsection NAME, set "
            "KEY = VALUE, end, # comment");
}

TEST(InputFile, MandatoryKeys)
{
  const InputFile file = InputFile::from_text("f.prm", good);
  EXPECT_EQ(file.require("Mesh", "Lower corner"), "1, -2");
  EXPECT_EQ(file.get("Mesh", "Upper corner", "none"), "none");
  EXPECT_EQ(message_of<InputError>(
              [&] { file.require("Materials/sand", "Young modulus"); }),
            "f.prm:12: section 'Materials/sand', key 'Young modulus': is not "
            "set, and has no default");
  EXPECT_EQ(message_of<InputError>([&] { file.require("Time", "End"); }),
            "f.prm: section 'Time', key 'End': is not set, and has no default");
}

TEST(InputFile, UnreadableFiles)
{
  EXPECT_EQ(message_of<InputError>([] { InputFile::read("/no/such.prm"); }),
            "/no/such.prm: cannot be read: No such file or directory");
  EXPECT_EQ(message_of<InputError>([] { InputFile::read("/tmp"); }),
            "/tmp: cannot be read: it is a directory");
  const std::string long_name(300, 'a');
  EXPECT_EQ(message_of<InputError>([&] { InputFile::read(long_name); }),
            long_name + ": cannot be read: File name too long");
}

TEST(Patterns, InWords)
{
  namespace p = moraine::patterns;
  using moraine::describe;
  EXPECT_EQ(describe(p::positive()), "a number > 0");
  EXPECT_EQ(describe(p::non_negative()), "a number >= 0");
  EXPECT_EQ(describe(p::number()), "a number");
  EXPECT_EQ(describe(dealii::Patterns::Double(-1, 0.5)),
            "a number from -1 to 0.5");
  EXPECT_EQ(describe(p::integer_in_range(1, 9)), "a whole number from 1 to 9");
  EXPECT_EQ(describe(dealii::Patterns::Integer(0)), "a whole number >= 0");
  EXPECT_EQ(describe(p::numbers(3, 3)), "3 numbers, separated by commas");
  EXPECT_EQ(describe(p::numbers()), "numbers, separated by commas");
  EXPECT_EQ(describe(dealii::Patterns::List(p::positive(), 1)),
            "one or more numbers > 0, separated by commas");
  EXPECT_EQ(describe(p::positive_integers(2, 3)),
            "2 to 3 whole numbers >= 1, separated by commas");
  EXPECT_EQ(describe(p::several_of({"a", "b"})),
            "any of a, b, separated by commas");
  EXPECT_EQ(describe(dealii::Patterns::Bool()), "true or false");
  EXPECT_EQ(describe(dealii::Patterns::Anything()), "any text");
  EXPECT_EQ(describe(dealii::Patterns::FileName()), "the name of a file");
  EXPECT_EQ(describe(p::NumberText()), "numbers in a text");
  EXPECT_EQ(describe(dealii::Patterns::Selection("|inside|outside")),
            "one of nothing, inside, outside");
  EXPECT_EQ(describe(
              dealii::Patterns::Map(dealii::Patterns::Anything(), p::number())),
            "pairs 'name: value', each value a number, separated by commas");
}



TEST(InputFile, ConstantsMayUseEarlierOnes)
{
  const Scene scene = parse(InputFile::from_text("s.prm",
                                                 "subsection Constants\n"
                                                 "  set digit = 7\n"
                                                 "  set size = $digit.5\n"
                                                 "end\n"
                                                 "subsection Mesh\n"
                                                 "  set Cell size = 1$size\n"
                                                 "end\n"));
  EXPECT_EQ(scene.size, 17.5);
}



TEST(InputFile, ConstantsBesideOperators)
{
  const auto with = [](const std::string &text, const std::string &value) {
    return with_constants(text, "here", {{"c", value}});
  };
  EXPECT_EQ(with("2*$c", "1+t"), "2*(1+t)");
  EXPECT_EQ(with("0; -$c", "x - 1"), "0; -(x - 1)");
  EXPECT_EQ(with("$c/3", "t < 1 ? t : 1"), "(t < 1 ? t : 1)/3");
  EXPECT_EQ(with("2*($c)", "1+t"), "2*(1+t)");
  EXPECT_EQ(with("x > $c", "t < 1 ? t : 1"), "x > (t < 1 ? t : 1)");
  EXPECT_EQ(with("0; $c", "1+t"), "0; 1+t");
  EXPECT_EQ(with("2*$c", "sin(1+t)"), "2*sin(1+t)");
  EXPECT_EQ(with("$c^2", "-3"), "(-3)^2");
  EXPECT_EQ(with("$c*2", "-3"), "-3*2");
  EXPECT_EQ(with("meshes/$c.msh", "slope-1"), "meshes/slope-1.msh");
}



TEST(InputFile, ConstantsDoNotUseLaterOnesOrThemselves)
{
  const auto message = [](const std::string &constants) {
    return message_of<InputError>([&]() {
      parse(InputFile::from_text("s.prm",
                                 "subsection Constants\n" + constants +
                                   "end\n"
                                   "subsection Mesh\n"
                                   "  set Cell size = $size\n"
                                   "end\n"));
    });
  };
  EXPECT_EQ(message("  set size = $digit\n  set digit = 7\n"),
            "s.prm:2: section 'Constants', key 'size': found '$digit'; no "
            "constant is defined before it. Allowed here: nothing");
  EXPECT_EQ(message("  set size = 2*$size\n"),
            "s.prm:2: section 'Constants', key 'size': found '$size'; no "
            "constant is defined before it. Allowed here: nothing");
}



TEST(InputFile, ArithmeticWhereNumbersAre)
{
  const auto scene = [](const std::string &size) {
    return parse(InputFile::from_text("s.prm",
                                      "subsection Constants\n"
                                      "  set half = 1/2\n"
                                      "  set depth = -3\n"
                                      "  set all = $half+$half\n"
                                      "  set material = clay\n"
                                      "end\n"
                                      "subsection Mesh\n"
                                      "  set Cell size = " +
                                        size +
                                        "\n"
                                        "  set Lower corner = 100/7, $depth*2\n"
                                        "  set Count = 0.3/0.1\n"
                                        "end\n"));
  };
  EXPECT_EQ(scene("$half*2").size, 1);
  EXPECT_EQ(scene("2*$all").size, 2); // the value of a constant, not its text
  EXPECT_EQ(scene("$depth^2").size, 9);
  EXPECT_EQ(scene("7-$depth").size, 10);
  EXPECT_EQ(scene("max(2, $half) * cos(2*pi)").size, 2);
  EXPECT_EQ(scene("1").corner, dealii::Point<2>(100. / 7., -6));
  EXPECT_EQ(scene("1").n, 3); // 2.9999999999999996 in binary
  const std::string found = "s.prm:8: section 'Mesh', key 'Cell size': found '";
  const auto        message = [&](const std::string &size) {
    return message_of<InputError>([&] { scene(size); });
  };
  EXPECT_EQ(message("1-$half*2"),
            found + "1-0.5*2', which is 0, allowed: a number > 0");
  for (const char *bad : {"1/0", "2*", "E*2", "(1", "1, 2", "rand()", "x"})
    EXPECT_EQ(message(bad), found + bad + "', allowed: a number > 0");
}



TEST(InputFile, ArithmeticLeavesTextAlone)
{
  dealii::ParameterHandler prm;
  std::string              name, corners;
  prm.add_parameter("Name", name);
  prm.add_parameter("Corners", corners, "", moraine::patterns::NumberText());
  InputFile::from_text("s.prm",
                       "subsection Constants\n  set a = -3\n  set b = 1/4\n"
                       "  set word = 2 + x\nend\n"
                       "set Name = 10-3 of $a, $word\n"
                       "set Corners = 0 $a; $a*2 (1 + 1), true : $b\n")
    .parse(prm);
  EXPECT_EQ(name, "10-3 of -3, 2 + x");
  EXPECT_EQ(corners, "0 -3; -6 2, true : 0.25");
}



TEST(InputFile, SaysWhatDiffersFromDefaults)
{
  Scene                    scene;
  dealii::ParameterHandler prm;
  const InputFile          file =
    InputFile::from_text("f.prm",
                         "set Method = GIMP\nsubsection Mesh\n"
                         "set Cell size = 1.0\nset Count = 3\nend\n");
  scene.declare(prm, file);
  const auto given = file.parse(prm);
  ASSERT_EQ(given.size(), 1);
  EXPECT_EQ(given[0].key, "Count");
}
