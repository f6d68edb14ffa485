// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/exceptions.h>
#include <moraine/study/study_expansion.h>

#include <gtest/gtest.h>

using namespace moraine;

namespace
{
  std::vector<StudyCase>
  expand(const std::string &text)
  {
    return expand_study(InputFile::from_text("s.prm", text));
  }

  std::string
  mistake(const std::string &text)
  {
    try
      {
        expand(text);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

TEST(StudyExpansion, AllCombinations)
{
  const auto cases = expand("set Method = {{FE|MPM}}\n"
                            "subsection Mesh\n"
                            "  set Cell size = {{ 4 | 2 | 1 }} # metres\n"
                            "  set Order = 1\n"
                            "end\n");
  ASSERT_EQ(cases.size(), 6u);
  EXPECT_EQ(cases[0].label, "Method = FE, Cell size = 4");
  EXPECT_EQ(cases[1].label, "Method = FE, Cell size = 2");
  EXPECT_EQ(cases[5].label, "Method = MPM, Cell size = 1");
  EXPECT_EQ(cases[4].choices[1].first, "Mesh/Cell size");
  EXPECT_EQ(cases[4].choices[1].second, "2");
  EXPECT_EQ(cases[4].input.require("Mesh", "Cell size"), "2");
  EXPECT_EQ(cases[4].input.require("", "Method"), "MPM");
  EXPECT_EQ(cases[4].input.require("Mesh", "Order"), "1");
  EXPECT_EQ(cases[4].input.entries()[1].origin, "s.prm:3");
  EXPECT_EQ(cases[4].input.text().find("{{"), std::string::npos);
}

TEST(StudyExpansion, WithinAValue)
{
  const auto cases = expand("set Corner = {{1|2}}, {{min(a|b, c)|4}}e{{0|1}}");
  ASSERT_EQ(cases.size(), 8u);
  EXPECT_EQ(cases[0].input.require("", "Corner"), "1, min(a|b, c)e0");
  EXPECT_EQ(cases[7].input.require("", "Corner"), "2, 4e1");
}

TEST(StudyExpansion, KeysOfTheSameName)
{
  const auto cases = expand("subsection a\nset E = {{1|2}}\nend\n"
                            "subsection b\nset E = {{3}}\nend\n");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[1].label, "a/E = 2, b/E = 3");
}

TEST(StudyExpansion, NothingToChoose)
{
  const auto cases = expand("set Method = FE\n");
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].label, "");
  EXPECT_TRUE(cases[0].choices.empty());
}

TEST(StudyExpansion, Mistakes)
{
  EXPECT_EQ(mistake("\nset A = {{1|2\n"),
            "s.prm:2: key 'A': found '{{1|2', a '{{' without '}}'");
  EXPECT_EQ(mistake("set A = 1|2}}\n"),
            "s.prm:1: key 'A': found '1|2}}', a '}}' without '{{'");
  EXPECT_EQ(mistake("set A = {{1||2}}\n"),
            "s.prm:1: key 'A': found '{{1||2}}', which has an empty choice; "
            "allowed: {{first|second|...}}");
  EXPECT_EQ(mistake("subsection {{a|b}}\nset A = 1\nend\n"),
            "s.prm:2: section '{{a|b}}', key 'A': '{{' is allowed in values "
            "only");
}
