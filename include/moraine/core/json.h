// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_json_h
#define moraine_core_json_h

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace moraine
{
  /**
   * A JSON value to be written. Members keep the order in which they were first
   * named:
   * @code
   *   Json summary;
   *   summary["status"] = "ok";
   *   summary["errors"]["r_u"] = 1e-10;
   *   summary["reactions"]["left"] = std::vector<double>{1., 2.};
   *   summary.save("summary.json");
   * @endcode
   * Numbers are written with as many digits as reading them back exactly needs;
   * nan and infinities, which JSON lacks, as null.
   */
  class Json
  {
  public:
    /** null; becomes an object or array by operator[] or push_back(). */
    Json() = default;

    Json(const bool value);
    Json(const double value);
    Json(const std::string &value);
    Json(const char *value);

    template <typename Integer,
              typename = std::enable_if_t<std::is_integral_v<Integer>>>
    Json(const Integer value)
      : content(static_cast<std::int64_t>(value))
    {}

    template <typename T>
    Json(const std::vector<T> &values)
      : content(Array(values.begin(), values.end()))
    {}

    static Json
    array();

    static Json
    object();

    /** Member @p name, made (as null) if it is not there. */
    Json &
    operator[](const std::string &name);

    /** Append to an array. */
    void
    push_back(const Json &value);

    /** Indented by two spaces; arrays of plain values on one line. */
    void
    write(std::ostream &out) const;

    /**
     * Write to a file that appears complete or not at all.
     * @throw InputError naming the file if that fails.
     */
    void
    save(const std::string &path) const;

  private:
    using Array  = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;

    void
    write(std::ostream &out, const unsigned int indent) const;

    void
    write_array(std::ostream &out, const unsigned int indent) const;

    void
    write_object(std::ostream &out, const unsigned int indent) const;

    std::variant<std::monostate,
                 bool,
                 std::int64_t,
                 double,
                 std::string,
                 Array,
                 Object>
      content;
  };
} // namespace moraine

#endif
