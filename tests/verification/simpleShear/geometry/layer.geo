// Four cells of an endless layer: the grid is periodic along x.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 4, 12};
Physical Surface("soil") = {1};
