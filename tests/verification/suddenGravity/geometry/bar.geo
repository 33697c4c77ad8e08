// A bar 10 m high and one cell wide: check.py halves the width with the cells.
width = 0.5;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, 10};
Physical Surface("bar") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
