// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Velocities of nodes and works in archives.

#include <moraine/state/motion.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Motion<dim>::write(Archive &archive) const
  {
    const std::string energy = "force length";
    archive.write("motion/works",
                  std::vector<double>(std::begin(done.of_forces),
                                      std::end(done.of_forces)),
                  1,
                  energy);
    archive.write("motion/work_of_prescribed", done.of_prescribed, energy);
    archive.write("motion/lost_in_transfer", done.lost_in_transfer, energy);
    archive.write("motion/lost_stored", done.lost_stored, energy);
    archive.write("motion/kinetic_at_start", done.kinetic_at_start, energy);
    archive.write("motion/kinetic", done.kinetic, energy);
    archive.write("motion/stored_at_start", done.stored_at_start, energy);
    archive.write("motion/stored", done.stored, energy);
    archive.write("motion/dissipated", done.dissipated, energy);
    archive.write("motion/begun", done.begun ? 1u : 0u);
    if (points_carry())
      return;
    state.grid().write_node_values(v,
                                   "motion/velocity",
                                   "length/time",
                                   archive);
    state.grid().write_node_values(a,
                                   "motion/acceleration",
                                   "length/time^2",
                                   archive);
    if (before_field.exists())
      state.grid().write_node_values(a_before,
                                     "motion/acceleration_before",
                                     "length/time^2",
                                     archive);
  }



  template <int dim>
  void
  Motion<dim>::read(const Archive &archive)
  {
    const auto &works = archive.numbers("motion/works");
    massless_found    = false;
    AssertThrow(works.size() == Works::n_kinds, ExcInternalError());
    std::copy(works.begin(), works.end(), done.of_forces);
    done.of_prescribed    = archive.number("motion/work_of_prescribed");
    done.lost_in_transfer = archive.number("motion/lost_in_transfer");
    done.lost_stored      = archive.number("motion/lost_stored");
    done.kinetic_at_start = archive.number("motion/kinetic_at_start");
    done.kinetic          = archive.number("motion/kinetic");
    done.stored_at_start  = archive.number("motion/stored_at_start");
    done.stored           = archive.number("motion/stored");
    done.dissipated       = archive.number("motion/dissipated");
    done.begun            = archive.integer("motion/begun") != 0;
    if (points_carry())
      return;
    state.grid().read_node_values(archive, "motion/velocity", v);
    state.grid().read_node_values(archive, "motion/acceleration", a);
    if (before_field.exists())
      state.grid().read_node_values(archive,
                                    "motion/acceleration_before",
                                    a_before);
  }



  template void
  Motion<2>::write(Archive &) const;
  template void
  Motion<3>::write(Archive &) const;
  template void
  Motion<2>::read(const Archive &);
  template void
  Motion<3>::read(const Archive &);
} // namespace moraine
