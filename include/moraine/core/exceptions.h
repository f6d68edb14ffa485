// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_exceptions_h
#define moraine_core_exceptions_h

#include <stdexcept>
#include <string>

namespace moraine
{
  /**
   * A mistake in what the user gave us. The message names file or section, key,
   * what was found and what is allowed, and is shown as it is. Exit code 2.
   */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * The computation could not go on: no convergence at the smallest step, a
   * point left the mesh, a scene is not held. Exit code 1. The last accepted
   * step is on disk when this is shown.
   */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** No equilibrium was found with the smallest step, and not for want of
   * linear iterations: as far as can be told there is none. */
  class NoEquilibrium : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /**
   * How a message names a key: "section 'Materials/clay', key 'Density'".
   * @p section is the path of subsections joined by '/'; empty for the top.
   */
  inline std::string
  place(const std::string &section, const std::string &key)
  {
    return (section.empty() ? std::string() : "section '" + section + "', ") +
           "key '" + key + "'";
  }

  /** @throw InputError about the text found in a key. */
  [[noreturn]] inline void
  reject(const std::string &section,
         const std::string &key,
         const std::string &found,
         const std::string &allowed)
  {
    throw InputError(place(section, key) + ": found '" + found +
                     "', allowed: " + allowed);
  }
} // namespace moraine

#endif
