// One period of the bar and its odd extension, one cell thick: check.py halves the thickness with the cells.
thickness = 0.0625;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, thickness};
Physical Surface("bar") = {1};
Physical Curve("below") = {1};
Physical Curve("above") = {3};
