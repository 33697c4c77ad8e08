// A column one cell wide.
width = 0.5;
height = 5;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, height};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
