// A bar 25 m long and one cell thick: check.py halves the thickness with the cells.
thickness = 2.5;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 25, thickness};
Physical Surface("bar") = {1};
Physical Curve("below") = {1};
Physical Curve("above") = {3};
Physical Curve("clamp") = {4};
