// A bar 1 m long and one cell thick: check.py halves the thickness with the cells.
thickness = 0.0625;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, thickness};
Physical Surface("bar") = {1};
Physical Curve("below") = {1};
Physical Curve("right") = {2};
Physical Curve("above") = {3};
Physical Curve("left") = {4};
