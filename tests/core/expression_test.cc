// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/arithmetic.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/expression.h>

#include <gtest/gtest.h>


#include "message.h"

using dealii::Point;
using moraine::Expression;
using moraine::InputError;
using moraine::TimeCurve;

namespace
{
  const std::string here = moraine::place("Loads/wind", "Traction");

  std::string
  mistake(const std::string &text, const unsigned int n = 1)
  {
    return message_of<InputError>([&] { Expression<2>(text, here, n); });
  }

  std::string
  curve_mistake(const std::string &text)
  {
    return message_of<InputError>([&] { TimeCurve(text, here); });
  }
} // namespace

TEST(Expression, Values)
{
  const Expression<2> f("x + 2*y; sin(pi*t)", here, 2);
  EXPECT_DOUBLE_EQ(f.value(Point<2>(3, 4), 7.), 11.);
  EXPECT_DOUBLE_EQ(f.value(Point<2>(3, 4), 0.5, 1), 1.);
  const auto v = f.vector_value(Point<2>(1, 1), 0.5);
  EXPECT_DOUBLE_EQ(v[0], 3.);
  EXPECT_DOUBLE_EQ(v[1], 1.);

  // Commas separate components too, but not inside brackets.
  const Expression<3> g("if(x > 0, z, -z), a*t, 3", here, 3, {{"a", 5.}});
  EXPECT_DOUBLE_EQ(g.value(Point<3>(-1, 0, 2)), -2.);
  EXPECT_DOUBLE_EQ(g.value(Point<3>(), 2., 1), 10.);
  EXPECT_DOUBLE_EQ(g.value(Point<3>(), 2., 2), 3.);

  const Expression<2> constant("0, -9.81e0", here, 2);
  EXPECT_EQ(constant.value(Point<2>(), 0., 1), -9.81);

  // Names of functions and constants have letters of variables.
  const Expression<2> turned("exp(a_x)*cos(pi); sqrt(2)^2",
                             here,
                             2,
                             {{"a_x", 0.}});
  EXPECT_DOUBLE_EQ(turned.value(Point<2>(3, 4), 5., 0), -1.);
  EXPECT_DOUBLE_EQ(turned.value(Point<2>(3, 4), 5., 1), 2.);
}

TEST(Expression, NamesAreWholeWords)
{
  for (const char *text : {"x", "2*x", "sin(x)", "a_x+x", "(y>0)?x:1"})
    EXPECT_TRUE(moraine::has_name(text, {"x", "t"})) << text;
  for (const char *text : {"", "exp(a_x)", "x1", "max(1,2)", "sqrt(2)"})
    EXPECT_FALSE(moraine::has_name(text, {"x", "t"})) << text;
}

TEST(Expression, Copies)
{
  const Expression<2> f("t*x", here);
  const auto          g = f;
  EXPECT_EQ(f.value(Point<2>(1, 0), 2.), 2.);
  EXPECT_EQ(g.value(Point<2>(1, 0), 3.), 3.);
  EXPECT_EQ(f.value(Point<2>(1, 0), 2.), 2.);
}

TEST(Expression, Mistakes)
{
  const std::string start = "section 'Loads/wind', key 'Traction': found ";
  EXPECT_EQ(mistake("x + q").rfind(start + "'x + q': ", 0), 0u)
    << mistake("x + q");
  EXPECT_NE(mistake("x + q").find("\"q\""), std::string::npos)
    << mistake("x + q");
  EXPECT_NE(mistake("x + q").find("an expression in x,y,t"), std::string::npos);
  for (const char *bad : {"x +", "(x", "x y", "sin()", "z", "", "nan", "x;"})
    EXPECT_EQ(mistake(bad).rfind(start, 0), 0u) << bad << mistake(bad);
  // The second of two is to blame.
  EXPECT_EQ(mistake("x; 3*", 2).rfind(start + "'3*': ", 0), 0u)
    << mistake("x; 3*", 2);
  EXPECT_EQ(mistake("1,5"),
            start + "'1,5', which has 2 components. Allowed: an expression in "
                    "x,y,t with the constant pi");
}

TEST(Expression, NotANumber)
{
  const Expression<2> f("1; sqrt(x)/(t-1)", here, 2);
  EXPECT_EQ(message_of<InputError>([&] { f.value(Point<2>(4, 2), 1., 1); }),
            "section 'Loads/wind', key 'Traction': 'sqrt(x)/(t-1)' is inf, not "
            "a finite number, at (4 2) and t = 1.");
  EXPECT_THROW(f.value(Point<2>(-1, 0), 0., 1), InputError);
  EXPECT_EQ(f.value(Point<2>(4, 0), 2., 1), 2.);
}

TEST(TimeCurve, Expressions)
{
  EXPECT_EQ(TimeCurve("2.5", here).value(7.), 2.5);
  EXPECT_DOUBLE_EQ(TimeCurve("min(t, 1)", here).value(0.3), 0.3);
  EXPECT_DOUBLE_EQ(TimeCurve("t < 1 ? t : 4", here).value(3), 4.);
  const TimeCurve f("1/(t - 2)", here);
  EXPECT_EQ(f.value(4.), 0.5);
  EXPECT_EQ(message_of<InputError>([&] { f.value(2.); }),
            "section 'Loads/wind', key 'Traction': '1/(t - 2)' is inf, not a "
            "finite number, at t = 2.");
}

TEST(TimeCurve, Tables)
{
  const TimeCurve f("0: 0, 1: 2.5, 3: 0.5", here);
  EXPECT_EQ(f.value(-1), 0.);
  EXPECT_EQ(f.value(0), 0.);
  EXPECT_DOUBLE_EQ(f.value(0.5), 1.25);
  EXPECT_EQ(f.value(1), 2.5);
  EXPECT_DOUBLE_EQ(f.value(2), 1.5);
  EXPECT_EQ(f.value(3), 0.5);
  EXPECT_EQ(f.value(9), 0.5);
}

TEST(TimeCurve, OneForEachComponent)
{
  const auto tables = moraine::time_curves("0: 0, 2: 4; 0: 1, 1: 3", here, 2);
  EXPECT_DOUBLE_EQ(tables[0].value(1.), 2.);
  EXPECT_DOUBLE_EQ(tables[1].value(0.5), 2.);
  const auto mixed = moraine::time_curves("max(0, t) ; 0: 0, 1: 3", here, 2);
  EXPECT_DOUBLE_EQ(mixed[0].value(-1.), 0.);
  EXPECT_DOUBLE_EQ(mixed[1].value(0.5), 1.5);
  EXPECT_DOUBLE_EQ(moraine::time_curves("t, 2*t", here, 2)[1].value(3.), 6.);
  EXPECT_THROW(moraine::time_curves("t", here, 2), InputError);
  EXPECT_THROW(moraine::time_curves("0: 0, 1: 3", here, 2), InputError);
  EXPECT_THROW(moraine::time_curves("t; 1; 2", here, 2), InputError);
}

TEST(Expression, WithoutTime)
{
  EXPECT_EQ(Expression<2>("x - y", here, 1, {}, false).value({3, 1}), 2.);
  EXPECT_THROW(Expression<2>("x - t", here, 1, {}, false), InputError);
}

TEST(TimeCurve, Mistakes)
{
  const std::string start = "section 'Loads/wind', key 'Traction': found ";
  EXPECT_EQ(curve_mistake("0: 0, 2: 1, 2: 3"),
            start + "'2: 3' in a table, but time must increase");
  EXPECT_EQ(curve_mistake("0: 0, a: 1"),
            start + "'a: 1' in a table; allowed: 'time: value', two numbers");
  for (const char *bad : {"0: 0,", "0: nan", "0: 0, 1", "", "x", "t, t", "t +"})
    EXPECT_EQ(curve_mistake(bad).rfind(start, 0), 0u) << bad;
}
