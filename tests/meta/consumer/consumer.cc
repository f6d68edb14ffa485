// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/expression.h>
#include <moraine/core/version.h>

#include <iostream>

int
main()
{
  const moraine::Expression<2> twice("2*x", "consumer");
  std::cout << "Moraine " << moraine::version << ": twice 21 is "
            << twice.value(dealii::Point<2>(21, 0)) << std::endl;
}
