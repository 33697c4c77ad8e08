// The same block, one cell thick.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1.5, 2, 0.25};
Physical Volume("soil") = {1};
