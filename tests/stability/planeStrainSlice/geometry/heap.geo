// A block of soil in plane strain.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1.5, 2};
Physical Surface("soil") = {1};
