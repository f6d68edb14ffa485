// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/catalogue.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

#include <algorithm>

namespace moraine
{
  const std::vector<Diagnostic> &
  catalogue()
  {
    constexpr Severity warning = Severity::warning, hint = Severity::hint;
    static const std::vector<Diagnostic> all{
      {"absent-probe",
       hint,
       "stage",
       "The body of a probe is not there in this stage.",
       "The probe has no value until its body comes.",
       "Remove the probe, or name a body that is there."},
      {"absorbing-boundary",
       warning,
       "stage",
       "An absorbing boundary holds nothing without inertia, does not act on a "
       "body that came later, loses places with a body, or cannot carry on the "
       "forces that held the bodies before.",
       "The value is the lost share of its area or forces (limit 0.01 for "
       "forces).",
       "Let the boundary hold in stages without inertia and name it in "
       "'Absorbing' of the stage with waves; add a second boundary for bodies "
       "that come later."},
      {"bodies-meet",
       warning,
       "stage, step",
       "Two bodies share nodes although they do not touch, or have come "
       "together. There is no contact between bodies: they stick, and pull when "
       "they part.",
       "The value is their distance or overlap; bodies act on each other from "
       "a distance of two cells on.",
       "Use cells smaller than half of the gap. With a mesh that follows the "
       "material use 'Method = GIMP'."},
      {"cell-crossing",
       warning,
       "step",
       "Points of method 'material point' cross cells, where the gradients of "
       "the shape functions jump.",
       "The value is the mean share of the forces that is out of balance as "
       "steps begin; above 0.25 forces and settlements were 7 to 70 % off.",
       "Use 'Method = GIMP' or 'CPDI1'."},
      {"coarse-load",
       warning,
       "stage",
       "The expression of a body force changes between points.",
       "The value is the relative error of its force (limit 0.05).",
       "Let the expression change on mesh lines, or take smaller cells."},
      {"coarse-stress",
       warning,
       "end",
       "Cells do not resolve the stress, or it is largest in cells that the "
       "body fills by less than a half.",
       "The value is the estimated error of stress in the energy norm (limit "
       "0.25) or the ratio of the largest stresses (limit 3). Of an elastic "
       "body under given forces the square of the error estimates the share of "
       "the deflection that the mesh holds back.",
       "Take smaller cells; for cut cells set 'Aggregate below'."},
      {"conflicting-constraints",
       warning,
       "stage",
       "Two boundaries or conditions that move differently meet in a cell, "
       "which cannot follow both.",
       "A gap of up to one cell between them is not held and keeps its "
       "traction.",
       "Let the second surface end before the first, or take smaller cells."},
      {"energy-growth",
       warning,
       "step",
       "Boundaries, the integrator or the transfer of velocities make energy.",
       "The value is the energy made over the energy given (limit 0.05 in five "
       "steps). At 100 times the energy given the run ends.",
       "Take shorter steps; 'Integrator = generalised-alpha', 'Aggregate below "
       "= 0.1', 'Velocity transfer = APIC', or a larger 'Nitsche factor'."},
      {"fictitious-stiffness",
       hint,
       "step",
       "Too few points touch some nodes. Empty parts of cells get a small "
       "stiffness, in steps from 1e-10 to 1e-4 of the material's.",
       "The value is that fraction. A step is refused if these parts carry more "
       "than 0.1 % of the load.",
       "Use more points, or 'Aggregate below'."},
      {"ghost-term",
       warning,
       "step",
       "The ghost term of cut cells takes work.",
       "The value is its share of the work of a step (limit 0.05).",
       "Raise 'Ghost factor', or use 'Cut cells = aggregation'."},
      {"initial-imbalance",
       hint,
       "stage",
       "The initial stress is not in equilibrium.",
       "The value is the share of the forces out of balance (limit 1e-12). The "
       "first step without inertia removes it; with inertia it sets the bodies "
       "in motion.",
       "Begin with a stage without inertia."},
      {"large-domains",
       hint,
       "step",
       "Domains of points have grown beyond the cells around their point and "
       "see only the cells of their corners.",
       "The value is their number.",
       "Set 'Split domains = true', or use more points."},
      {"load-outside",
       warning,
       "stage",
       "A part of the surface of a load is outside the mesh or beside no body.",
       "The value is that share of its area (limit 0.05), which does not act.",
       "Draw the surface on the rim of the body."},
      {"lost-hold",
       warning,
       "step",
       "The material that a boundary held has come off, or a condition has "
       "pushed material off its nodes.",
       "The value is the distance in cells (limit 0.25, where the force on a "
       "pressed column is 3 % too small).",
       "Use a boundary with 'Translation', or 'Mesh motion'; else shorter steps "
       "or smaller cells."},
      {"nitsche-flux",
       hint,
       "stage",
       "The flux of Nitsche's method is elastic and of small strain.",
       "Beside material that yields reactions and limit loads are some per cent "
       "off.",
       "Use 'Enforcement = augmented Lagrangian', the default there."},
      {"no-effect",
       warning,
       "stage, end",
       "A condition holds no node, a load is 0 as long as it acts, a motion "
       "does not change, or nothing in the scene has moved.",
       "What was meant does not act.",
       "Displacements are the change since the condition began: -0.1*t reaches "
       "-0.1 at t = 1. Sides hold only bodies that reach them."},
      {"point-volumes",
       warning,
       "stage",
       "Points of a file are in it twice, have wrong volumes or do not fit the "
       "cells; or a body comes where material has moved.",
       "The value is the excess volume (limits 0.22 in 2D, 0.3 in 3D), the "
       "unevenness (0.1) or the share of the new body (0.05).",
       "Check the volumes; use 'Method = GIMP'; draw a body that comes later "
       "from where the surface is."},
      {"points-apart",
       warning,
       "step",
       "Neighbouring points are stretched apart, so that cells hold too few.",
       "Forces are 5 to 11 % too small where it is said first. The value is the "
       "share of the body (limit 0.01).",
       "Use CPDI1, CPDI2, or GIMP with 'Domain update = corners', whose domains "
       "are split; or more points; or larger cells."},
      {"removed-body",
       warning,
       "stage",
       "A load or a boundary lies on a body that goes.",
       "The value is the share of its surface (limit 0.5) or points (0.05). From then on it acts "
       "on what is left beside it.",
       "Leave it out of 'Loads' or 'Boundaries' of the stage."},
      {"returned-points",
       hint,
       "step",
       "Points ended outside the mesh by less than the tolerance and were "
       "returned to its edge.",
       "The value is their number in the step.",
       "Enlarge the mesh, or hold the body before its edge."},
      {"separation",
       warning,
       "step",
       "A body came apart: parts of it share no node and carry no force across.",
       "The value is the share of its volume (limit 0.01). The run ends unless "
       "'Separation = note'.",
       "Use domains that are split, more points per direction, or larger cells."},
      {"shared-cells",
       warning,
       "stage",
       "Cells are shared by a stiff and a soft body and become as stiff as the "
       "stiff one.",
       "The value is the share of the soft body's compression that they hold "
       "back (limit 0.05); limit loads become too high.",
       "Let the stiff body end on mesh lines, or take smaller cells."},
      {"slide",
       warning,
       "step",
       "Material moved much faster in some steps and came to rest: a limit load "
       "is passed.",
       "The value is the ratio of the rates (limit 5). What follows is another "
       "shape of the body.",
       "Find the limit with 'Mesh after step = keep', 'Arc length', or 'Kind = "
       "factor of safety' in section 'Study'."},
      {"small-strain",
       warning,
       "step, end",
       "Strain, turns or motions are not small, but 'Strain = small'.",
       "The value is the mean strain (limit 0.05), the strain of the turn over "
       "the elastic one (0.2), or the motion over the size of the body (1; 0.35 "
       "between its parts). Stresses and forces are off by about as much.",
       "Use 'Strain = finite', or 'Mesh after step = keep' for what is linear."},
      {"stress-oscillation",
       warning,
       "end",
       "Mean stress jumps from cell to cell: volume locks, or points cross "
       "cells. Double mapping locks without jumps.",
       "The value is the jump over the deviatoric stress (limit 1).",
       "Use 'Volumetric strain = cell mean', or 'Method = GIMP'."},
      {"surface-coverage",
       warning,
       "stage, step",
       "A boundary ends inside cells and holds all of them, a condition holds "
       "faces or nodes off the body, or material has grown past the end of a "
       "surface.",
       "The value is the area beyond its own (limit 0.05), the share off bodies "
       "(0.5), or the depth behind its end in cells (0.1). Forces are off by as "
       "much or more.",
       "End surfaces and bodies on faces of cells, take smaller cells, or draw "
       "a surface that is longer than the body."},
      {"surface-miss",
       warning,
       "step",
       "Material misses a boundary that holds it, or has passed it in cells "
       "that no longer hold.",
       "The value is the miss over the largest motion of a step (limit 0.05), "
       "or the depth behind it (limit a tenth of a cell). A run ends where the "
       "depth grows by half a cell.",
       "Take smaller cells or steps, or end the boundary on faces of cells."},
      {"surface-place",
       warning,
       "stage",
       "A boundary begins away from the bodies or inside one.",
       "The value is the gap (limit a tenth of a cell) or the depth of the "
       "material behind it (a quarter). A gap is held as if it were filled.",
       "Draw the surface on the rim of the body, where it is by then."},
      {"thin-body",
       warning,
       "stage",
       "A body is nowhere thicker than one and a half cells.",
       "Bending is much too stiff; with 'Volumetric strain = cell mean' much too "
       "soft.",
       "Take smaller cells, or finite elements with 'Degree = 2'."},
      {"velocity-jump",
       hint,
       "stage",
       "The velocity of the bodies and that of what holds them differ as "
       "dynamics begins.",
       "The value is the difference over the largest velocity (limit 0.001, at "
       "points 0.25). It is a shock wave.",
       "Let motions begin with the velocity of the body."}};
    return all;
  }



  const Diagnostic &
  diagnostic(const std::string &id, const std::string &origin)
  {
    std::vector<std::string> ids;
    for (const Diagnostic &one : catalogue())
      {
        if (one.id == id)
          return one;
        ids.push_back(one.id);
      }
    throw InputError(origin + ": found '" + id + "'" + suggest(id, ids));
  }



  std::string
  explanation(const std::string &id)
  {
    const Diagnostic &one = diagnostic(id, "moraine explain");
    return one.id +
           (one.severity == Severity::warning ? " (warning)" : " (hint)") +
           "\n\nCause: " + one.cause + "\nHow large: " + one.size +
           "\nCure: " + one.cure + "\nAsked: at " + one.asked + ".\n";
  }



  void
  print_catalogue(std::ostream &out)
  {
    out << "# Diagnostics\n\nWritten by 'moraine explain'. A *warning* counts "
           "in the last line of a run and in summary.json; a *hint* is in "
           "log.txt. 'Output / Silence' names ids that are not asked.\n\n"
           "| id | severity | cause | how large | cure |\n"
           "|---|---|---|---|---|\n";
    for (const Diagnostic &one : catalogue())
      out << "| `" << one.id << "` | "
          << (one.severity == Severity::warning ? "warning" : "hint") << " | "
          << one.cause << " | " << one.size << " | " << one.cure << " |\n";
  }
} // namespace moraine
