// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/summary.h>

#include <moraine/core/json.h>
#include <moraine/core/words.h>
#include <moraine/output/on_root.h>

#include <nlohmann/json.hpp>

namespace moraine
{
  namespace
  {
    /** A list of names and values as an object, members in their order. */
    template <class T>
    Json
    object_of(const Summary::List<T> &list)
    {
      Json object = Json::object();
      for (const auto &[name, value] : list)
        object[name] = value;
      return object;
    }

    Json
    json_of(const std::vector<Finding> &findings)
    {
      Json list = Json::array();
      for (const Finding &finding : findings)
        list.push_back({{"id", finding.id},
                        {"object", finding.object},
                        {"value", finding.value},
                        {"limit", finding.limit},
                        {"t", finding.t},
                        {"text", finding.text}});
      return list;
    }

    Json
    to_json(const Summary &summary)
    {
      Json json;
      json["status"] = summary.status;
      if (!summary.message.empty())
        json["message"] = summary.message;
      json["version"] = summary.version;
      if (!summary.sizes.units.length.empty())
        json["units"] = {{"length", summary.sizes.units.length},
                         {"force", summary.sizes.units.force},
                         {"time", summary.sizes.units.time},
                         {"stress", summary.sizes.units.of("stress")}};
      json["dimension"]              = summary.sizes.dimension;
      json["ranks"]                  = summary.sizes.ranks;
      json["cells"]                  = summary.sizes.cells;
      json["active_cells"]           = summary.sizes.active_cells;
      json["unknowns"]               = summary.sizes.unknowns;
      json["points"]                 = summary.sizes.points;
      json["time"]                   = summary.time;
      json["steps"]                  = summary.steps;
      json["rejected_steps"]         = summary.rejected_steps;
      json["pseudo_transient_steps"] = summary.n_pseudo_transient;
      json["newton_iterations"]      = summary.newton_iterations;
      json["linear_iterations"]      = summary.linear.iterations;
      if (summary.linear.condition_number)
        json["condition_number"] = *summary.linear.condition_number;
      if (summary.quality.ghost_term)
        json["ghost_term"] = {
          {"share_of_forces", summary.quality.ghost_term->of_forces},
          {"share_of_work", summary.quality.ghost_term->of_work}};
      if (summary.quality.stress_error)
        json["estimated_stress_error"] = *summary.quality.stress_error;
      json["largest_displacement"] = summary.quality.largest_displacement;
      if (summary.quality.plastic_share)
        json["plastic_share"] = *summary.quality.plastic_share;
      json["bytes_per_point"] = summary.sizes.bytes_per_point;
      json["peak_memory_mib"] = summary.sizes.peak_memory_mib;
      json["wall_seconds"]    = summary.wall_seconds;
      json["timings"]         = object_of(summary.timings);
      json["effects"]         = summary.effects;
      json["linear_solvers"]  = summary.linear.solvers;
      if (!summary.found.warnings.empty())
        json["warnings"] = json_of(summary.found.warnings);
      if (!summary.found.hints.empty())
        json["hints"] = json_of(summary.found.hints);
      for (const auto &[name, value] : summary.errors)
        json["errors"][name] = value ? Json(*value) : Json();
      if (!summary.energy.empty())
        json["energy"] = object_of(summary.energy);
      json["probes"]    = object_of(summary.last.probes);
      json["reactions"] = object_of(summary.last.reactions);
      return json;
    }
  } // namespace



  void
  Summary::write(const std::string &path, const MPI_Comm &communicator) const
  {
    on_root(communicator, [&]() { save(to_json(*this), path); });
  }
} // namespace moraine
