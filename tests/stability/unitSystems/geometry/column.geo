// A soil column, 2 m by 4 m.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 4};
Physical Surface("soil") = {1};
