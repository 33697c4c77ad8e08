// A column between the walls of a box, as wide as they are apart or less.
SetFactory("OpenCASCADE");
width = 1;
Rectangle(1) = {-width / 2, 0, 0, width, 2};
Physical Surface("soil") = {1};
