// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_scene_renamed_keys_h
#define moraine_scene_renamed_keys_h

#include <moraine/core/input_file.h>

namespace moraine
{
  /**
   * Keys and values that earlier versions knew are refused with what they are
   * called now.
   * @throw InputError for the first of them.
   */
  void
  refuse_old_names(const InputFile &input);
} // namespace moraine

#endif
