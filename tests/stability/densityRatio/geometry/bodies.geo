// A heavy block and a light one, two cells apart.
SetFactory("OpenCASCADE");
Rectangle(1) = {1, 1, 0, 2, 1};
Rectangle(2) = {3.5, 1, 0, 2, 1};
Physical Surface("heavy") = {1};
Physical Surface("light") = {2};
