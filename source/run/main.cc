// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/version.h>

#include <iostream>

int
main()
{
  std::cout << "moraine " << moraine::version << std::endl;
}
