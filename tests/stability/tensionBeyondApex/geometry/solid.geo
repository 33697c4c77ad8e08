SetFactory("OpenCASCADE");
Box(1) = {-1, -1, -1, 2, 2, 2};
Physical Volume("soil") = {1};
