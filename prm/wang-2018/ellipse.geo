// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors
//
// Annulus: outer circle of radius 10, elliptical hole with semi-axes 6 (x) and
// 4 (y), quadrilaterals, finer at the ends of the long axis.
//   gmsh -2 -format msh2 -o ellipse.msh ellipse.geo

a = 6; b = 4; R = 10;
fine = 0.8; coarse = 1.3;

Point(1) = {0, 0, 0, coarse};
Point(2) = {a, 0, 0, fine};   Point(3) = {0, b, 0, coarse};
Point(4) = {-a, 0, 0, fine};  Point(5) = {0, -b, 0, coarse};
Point(6) = {R, 0, 0, fine * 2}; Point(7) = {0, R, 0, coarse * 1.3};
Point(8) = {-R, 0, 0, fine * 2}; Point(9) = {0, -R, 0, coarse * 1.3};

Ellipse(1) = {2, 1, 2, 3}; Ellipse(2) = {3, 1, 4, 4};
Ellipse(3) = {4, 1, 4, 5}; Ellipse(4) = {5, 1, 2, 2};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8};
Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};

Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {2, 1};

Mesh.Algorithm = 6;
Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 1;
Mesh.SubdivisionAlgorithm = 1;
Mesh.MeshSizeFactor = 2.1;

Physical Curve("hole", 1) = {1, 2, 3, 4};
Physical Curve("outer", 2) = {5, 6, 7, 8};
Physical Surface("annulus", 3) = {1};
