// A bar one cell thick.
length = 1;
width = 0.005;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, length, width};
Physical Surface("bar") = {1};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("wall") = {4};
