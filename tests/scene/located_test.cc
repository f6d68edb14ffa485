// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/object_error.h>
#include <moraine/scene/located.h>

#include <gtest/gtest.h>

namespace moraine
{
  TEST(Located, objects_get_their_section)
  {
    const InputFile input = InputFile::from_text("s.prm",
                                                 "subsection Loads\n"
                                                 "  subsection weight\n"
                                                 "    set Location = 1, 2\n"
                                                 "  end\n"
                                                 "end\n");
    EXPECT_STREQ(ObjectError("load", "weight", "found a").what(),
                 "load 'weight': found a");
    EXPECT_EQ(located(input, ObjectError("load", "weight", "found a")),
              "s.prm:2: section 'Loads/weight': found a");
    EXPECT_EQ(located(input, ObjectError("force on points", "weight", "b")),
              "s.prm:3: section 'Loads/weight', key 'Location': b");
    EXPECT_EQ(located(input, ObjectError("bodies", "", "'a' and 'b' overlap")),
              "s.prm: section 'Bodies': 'a' and 'b' overlap");
    EXPECT_EQ(located(input, InputError("key 'Title': c")),
              "s.prm: key 'Title': c");
    EXPECT_EQ(located(input, InputError("something else")), "something else");
  }
} // namespace moraine
