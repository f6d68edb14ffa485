// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/json.h>

#include <moraine/core/atomic_file.h>

#include <nlohmann/json.hpp>

namespace moraine
{
  void
  save(const Json &json, const std::string &path)
  {
    AtomicFile file(path);
    // Names of files may be in other encodings than UTF-8.
    file.stream() << json.dump(2, ' ', false, Json::error_handler_t::replace)
                  << '\n';
    file.commit();
  }
} // namespace moraine
