// A column one cell wide.
width = 0.8;
height = 8;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, height};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
