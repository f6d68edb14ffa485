// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_located_h
#define moraine_scene_located_h

#include <moraine/core/exceptions.h>
#include <moraine/core/input_file.h>

#include <string>

namespace moraine
{
  /**
   * The message of a mistake with the section of the object in which it shows,
   * and with the line of the file.
   */
  std::string
  located(const InputFile &input, const InputError &error);
} // namespace moraine

#endif
