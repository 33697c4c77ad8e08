// A column between the walls of a box.
SetFactory("OpenCASCADE");
Rectangle(1) = {-0.75, 0, 0, 1.5, 2};
Physical Surface("soil") = {1};
