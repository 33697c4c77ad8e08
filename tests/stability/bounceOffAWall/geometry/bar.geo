// A bar of eight cells, a cell from the wall x = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {0.25, 0, 0, 2, 0.25};
Physical Surface("bar") = {1};
