// A block in the middle of the grid.
SetFactory("OpenCASCADE");
Rectangle(1) = {3, 3, 0, 2, 2};
Physical Surface("soil") = {1};
