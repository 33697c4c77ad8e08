// A column one cell wide: check.py changes the width with the cells.
width = 2.5;
height = 50;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, height};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
