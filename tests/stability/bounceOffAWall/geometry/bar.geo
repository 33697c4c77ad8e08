// A bar of eight cells, a cell and a half from the wall x = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {0.375, 0, 0, 2, 0.25};
Physical Surface("bar") = {1};
