// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors
//
// A plate of 4 by 3 with a notch in quadrilaterals of different sizes.
//   gmsh -2 -format msh41 -o mesh-quads.msh mesh-quads.geo

Point(1) = {0, 0, 0, 0.9};
Point(2) = {4, 0, 0, 1.4};
Point(3) = {4, 3, 0, 0.8};
Point(4) = {2.3, 3, 0, 1.2};
Point(5) = {1.7, 2, 0, 0.5};
Point(6) = {0.9, 3, 0, 1};
Point(7) = {0, 3, 0, 1.3};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};

Mesh.Algorithm = 6;
Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 1;
Mesh.SubdivisionAlgorithm = 1;

Physical Curve("low", 11) = {1};
Physical Curve("sides", 12) = {2, 7};
Physical Curve("up", 13) = {3, 4, 5, 6};
Physical Surface("plate", 14) = {1};
