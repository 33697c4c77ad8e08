// The collapsing column at half its size.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 4};
Physical Surface("soil") = {1};
