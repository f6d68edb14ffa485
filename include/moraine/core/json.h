// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_json_h
#define moraine_core_json_h

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace moraine
{
  /** Members keep their order. What makes one includes <nlohmann/json.hpp>. */
  using Json = nlohmann::ordered_json;

  /**
   * Write to a file that appears complete or not at all. Reading the numbers
   * gives the same back; nan and infinities, which JSON lacks, become null.
   * @throw InputError naming the file if it cannot be written.
   */
  void
  save(const Json &json, const std::string &path);
} // namespace moraine

#endif
